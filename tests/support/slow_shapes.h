#pragma once

#include <span>
#include <vector>

#include "core/geometry/segment.h"

// Lines and arcs in extended precision, for the judges. Shares no code with
// core/geometry.

namespace trc::support {

using Extended = long double;

struct ExtendedPoint {
  Extended x = 0;
  Extended y = 0;
};

[[nodiscard]] ExtendedPoint operator+(const ExtendedPoint& a, const ExtendedPoint& b);
[[nodiscard]] ExtendedPoint operator-(const ExtendedPoint& a, const ExtendedPoint& b);
[[nodiscard]] ExtendedPoint operator*(Extended factor, const ExtendedPoint& a);
[[nodiscard]] Extended dot(const ExtendedPoint& a, const ExtendedPoint& b);
[[nodiscard]] Extended cross(const ExtendedPoint& a, const ExtendedPoint& b);
[[nodiscard]] Extended length(const ExtendedPoint& a);
[[nodiscard]] ExtendedPoint left_normal(const ExtendedPoint& a);

// What a bounded shape lies on: a straight line through `point` along the unit
// vector `along`, or a circle about `point`.
struct Carrier {
  bool round = false;
  ExtendedPoint point{};
  ExtendedPoint along{};
  Extended radius = 0;
};

// The points two carriers have in common. Those that miss each other by at most
// `slack` touch, and a touch is one point. None for parallel lines and circles
// with one centre.
[[nodiscard]] std::vector<ExtendedPoint> common_points(const Carrier& a, const Carrier& b,
                                                       Extended slack);

// A bounded line, or an arc of at most one turn. `sweep` in rad, as of Arc.
struct Shape {
  Carrier carrier{};
  ExtendedPoint start{};
  ExtendedPoint end{};
  Extended sweep = 0;
  Extended extent = 0;  // its length, mm

  // From the start, 0 … extent.
  [[nodiscard]] ExtendedPoint at(Extended way) const;
  // The way to a point of the carrier; beyond the extent if it lies outside. On
  // an arc, points just before the start have a negative way.
  [[nodiscard]] Extended way_to(const ExtendedPoint& point) const;
  // Unit vector of travel.
  [[nodiscard]] ExtendedPoint heading(Extended way) const;
  [[nodiscard]] Extended distance_to(const ExtendedPoint& point) const;
};

[[nodiscard]] Shape line_shape(const ExtendedPoint& start, const ExtendedPoint& end);
// Counter-clockwise for a positive sweep, from `start` round `center`.
[[nodiscard]] Shape arc_shape(const ExtendedPoint& center, const ExtendedPoint& start,
                              Extended sweep);
[[nodiscard]] Shape shape_of(const Segment& segment);
[[nodiscard]] Segment segment_of(const Shape& shape);

// The shortest distance between two bounded shapes.
[[nodiscard]] Extended distance(const Shape& a, const Shape& b);

// The shortest distance between a path and a contour, exact but for rounding,
// and the blocks it is between. Both must not be empty.
struct LeastDistance {
  double distance = 0;
  std::size_t path_block = 0;
  std::size_t contour_block = 0;
};
[[nodiscard]] LeastDistance least_distance(std::span<const Segment> path,
                                           std::span<const Segment> contour);

// The farthest any point of one path is from the other one, looked for at the
// ends of the pieces and at some points in between; both ways.
[[nodiscard]] double hausdorff(std::span<const Segment> a, std::span<const Segment> b);

}  // namespace trc::support
