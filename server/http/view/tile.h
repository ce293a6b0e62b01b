#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "server/http/view/elements.h"

namespace trc::server::http {

// A square of the picture as lines and arcs, simplified to what can be seen of it: each point that
// is left out lies within `tolerance` of what is drawn, and an element that must be seen is at
// least a dot. Bytes, little endian: "TRCT", their number (u32), the tolerance (f32, mm), 0 (u32),
// and for each of them x0 y0 x1 y1 (f32, mm from the square's lowest corner), the index of its
// element, its line, its style with flags (u32), the radius of the tool (f32, mm; 0: not
// compensated) and the sweep of an arc (f32, rad, at most half a turn; 0: a line). `plane` is the
// one that is shown.
struct Square {
  Point low = Point::Zero();
  double side = 0;  // mm
};
struct TileLimits {
  double tolerance = 0;  // mm; more where there would be too many segments
  std::size_t most_segments = 0;
};
[[nodiscard]] std::string tile_of(const Elements& contour, const Elements& path, Plane plane,
                                  const Square& square, const TileLimits& limits);

}  // namespace trc::server::http
