#pragma once

#include <algorithm>

#include "core/geometry/segment.h"

namespace trc {

// The shortest distance from the point to the bounded segment, mm.
[[nodiscard]] inline double distance(const Point& point, const Line& line) {
  const Vector along = line.end - line.start;
  const double squared = along.squaredNorm();
  if (squared == 0) return (point - line.start).norm();
  const double part = std::clamp((point - line.start).dot(along) / squared, 0.0, 1.0);
  return (point - (line.start + part * along)).norm();
}
[[nodiscard]] double distance(const Point& point, const Arc& arc);
[[nodiscard]] inline double distance(const Point& point, const Segment& segment) {
  const auto* arc = std::get_if<Arc>(&segment);
  return arc != nullptr ? distance(point, *arc) : distance(point, std::get<Line>(segment));
}

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
