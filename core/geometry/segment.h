#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <variant>

namespace trc {

// A point or direction in the compensation plane, mm. The first axis of the
// plane is x, the second y (G17: X Y, G18: Z X, G19: Y Z). Not aligned to 16 bytes, which
// would make every line and arc larger than it is.
using Point = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Vector = Point;

struct Line {
  Point start = Point::Zero();
  Point end = Point::Zero();

  bool operator==(const Line&) const = default;
};

// `sweep` in rad, positive counter-clockwise seen from the positive third axis,
// 0 < |sweep| <= 2 pi. It is stored because start == end cannot tell a full
// circle from nothing.
struct Arc {
  Point start = Point::Zero();
  Point end = Point::Zero();
  Point center = Point::Zero();
  double sweep = 0;

  bool operator==(const Arc&) const = default;
};

using Segment = std::variant<Line, Arc>;

template <class... Cases>
struct overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
overloaded(Cases...) -> overloaded<Cases...>;

// Left normal: the vector turned by +90 degrees.
[[nodiscard]] inline Vector left_of(const Vector& v) { return {-v.y(), v.x()}; }
[[nodiscard]] inline double cross(const Vector& a, const Vector& b) {
  return a.x() * b.y() - a.y() * b.x();
}

[[nodiscard]] inline bool is_arc(const Segment& s) { return std::holds_alternative<Arc>(s); }
[[nodiscard]] inline const Point& start_of(const Segment& segment) {
  const auto* arc = std::get_if<Arc>(&segment);
  return arc != nullptr ? arc->start : std::get<Line>(segment).start;
}
[[nodiscard]] inline const Point& end_of(const Segment& segment) {
  const auto* arc = std::get_if<Arc>(&segment);
  return arc != nullptr ? arc->end : std::get<Line>(segment).end;
}

// A vector as its direction, of length 1, and its length: one root for both.
struct Directed {
  Vector unit = Vector::UnitX();
  double length = 0;
};
[[nodiscard]] inline Directed directed(const Vector& v) {
  const double length = v.norm();
  return {.unit = length > 0 ? Vector(v / length) : v, .length = length};
}

// Unit vectors in travel direction. The segment has a length (D-29).
[[nodiscard]] inline Vector tangent_across(const Vector& radial, const Arc& arc) {
  return arc.sweep > 0 ? left_of(radial) : Vector(-left_of(radial));
}
[[nodiscard]] inline Vector tangent_at(const Point& point, const Arc& arc) {
  return tangent_across(directed(point - arc.center).unit, arc);
}
[[nodiscard]] inline Vector tangent_of(const Line& line) {
  return directed(line.end - line.start).unit;
}
[[nodiscard]] inline Vector tangent_at_start(const Segment& segment) {
  if (const auto* arc = std::get_if<Arc>(&segment)) return tangent_at(arc->start, *arc);
  return tangent_of(std::get<Line>(segment));
}
[[nodiscard]] inline Vector tangent_at_end(const Segment& segment) {
  if (const auto* arc = std::get_if<Arc>(&segment)) return tangent_at(arc->end, *arc);
  return tangent_at_start(segment);
}

[[nodiscard]] inline double radius_of(const Arc& arc) { return (arc.start - arc.center).norm(); }
[[nodiscard]] inline double length_of(const Line& line) { return (line.end - line.start).norm(); }
[[nodiscard]] inline double length_of(const Arc& arc) {
  return std::abs(arc.sweep) * radius_of(arc);
}
[[nodiscard]] inline double length_of(const Segment& segment) {
  if (const auto* arc = std::get_if<Arc>(&segment)) return length_of(*arc);
  return length_of(std::get<Line>(segment));
}

// An arc of the same sense through two other points; its centre is the old one,
// projected on their perpendicular bisector. Up to `same_point` mm apart, a line.
[[nodiscard]] Segment refitted(const Arc& arc, const Point& start, const Point& end,
                               double same_point);

// The signed turn from a to b in rad, -pi < turn <= pi.
[[nodiscard]] inline double turn_between(const Vector& a, const Vector& b) {
  const double sine = cross(a, b);
  const double cosine = a.dot(b);
  // Up to 135 degrees, as most turns are, one quotient is exact enough and its angle takes half of
  // the time.
  if (std::abs(sine) < cosine) return std::atan(sine / cosine);
  if (std::abs(cosine) < std::abs(sine))
    return std::copysign(std::numbers::pi / 2, sine) - std::atan(cosine / sine);
  const double turn = std::atan2(sine, cosine);
  return turn <= -std::numbers::pi ? std::numbers::pi : turn;
}

}  // namespace trc
