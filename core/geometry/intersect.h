#pragma once

#include <array>
#include <cstddef>

#include "core/geometry/segment.h"

namespace trc {

// An unbounded straight line through `point` along the unit vector `direction`.
struct StraightLine {
  Point point = Point::Zero();
  Vector direction = Vector::UnitX();
};

struct Circle {
  Point center = Point::Zero();
  double radius = 0;  // mm, positive
};

// Up to two points; no particular order.
struct Meetings {
  std::array<Point, 2> points{Point::Zero(), Point::Zero()};
  std::size_t count = 0;

  void add(const Point& point) { points[count++] = point; }
  [[nodiscard]] const Point* begin() const { return points.data(); }
  [[nodiscard]] const Point* end() const { return points.data() + count; }
};

// Where the two meet. Shapes that miss each other by at most `same_point` meet in
// one point, on the first shape's side of the gap. Parallel lines and circles
// with one centre do not meet.
[[nodiscard]] Meetings intersect(const StraightLine& a, const StraightLine& b);
[[nodiscard]] Meetings intersect(const StraightLine& line, const Circle& circle, double same_point);
[[nodiscard]] Meetings intersect(const Circle& a, const Circle& b, double same_point);

}  // namespace trc
