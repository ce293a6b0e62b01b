#pragma once

#include "core/geometry/segment.h"

namespace trc {

// The shortest distance from the point to the bounded segment, mm.
[[nodiscard]] double distance(const Point& point, const Segment& segment);

// Whether the sweep of the arc covers the direction from its centre to `point`.
[[nodiscard]] bool covers(const Arc& arc, const Point& point);

// Whether the two bounded pieces have a point in common, ends included.
[[nodiscard]] bool meet(const Line& line, const Segment& segment, double same_point);

}  // namespace trc
