#pragma once

#include "core/geometry/segment.h"

namespace trc {

// The shortest distance from the point to the bounded segment, mm.
[[nodiscard]] double distance(const Point& point, const Segment& segment);

// Whether the sweep of the arc covers the direction from its centre to `point`.
[[nodiscard]] bool covers(const Arc& arc, const Point& point);

// The shortest distance between two bounded segments, mm, and where on the first
// it is; one of the places if there are several.
struct Nearness {
  double distance = 0;
  Point on_first = Point::Zero();
};
[[nodiscard]] Nearness nearness(const Segment& first, const Segment& second, double same_point);

// Whether the two bounded pieces have a point in common, ends included.
[[nodiscard]] bool meet(const Line& line, const Segment& segment, double same_point);

}  // namespace trc
