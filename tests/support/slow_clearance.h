#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::support {

// The smallest distance between a path of the tool centre and a programmed
// contour, found by looking at many points.
struct SlowClearance {
  double distance = 0;  // mm
  Point where = Point::Zero();
  std::size_t path_block = 0;
  std::size_t contour_block = 0;
};

// Every `step` mm of the path against every block of the contour, then ever
// smaller steps around the nearest point found. Both must not be empty.
[[nodiscard]] SlowClearance slow_clearance(std::span<const Segment> path,
                                           std::span<const Segment> contour, double step);

// Distance of a point to a segment, mm.
[[nodiscard]] double slow_distance(const Point& point, const Segment& segment);

}  // namespace trc::support
