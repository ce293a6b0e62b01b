#include "core/geometry/segment.h"

#include <cmath>
#include <numbers>

namespace trc {
namespace {

// The tangent of a circle at a point, in the sense of travel.
Vector circle_tangent(const Point& point, const Point& center, double sweep) {
  const Vector radial = (point - center).normalized();
  return sweep > 0 ? left_of(radial) : Vector(-left_of(radial));
}

}  // namespace

Vector tangent_at_start(const Segment& segment) {
  return std::visit(
      overloaded{
          [](const Line& line) -> Vector { return (line.end - line.start).normalized(); },
          [](const Arc& arc) { return circle_tangent(arc.start, arc.center, arc.sweep); },
      },
      segment);
}

Vector tangent_at_end(const Segment& segment) {
  return std::visit(
      overloaded{
          [](const Line& line) -> Vector { return (line.end - line.start).normalized(); },
          [](const Arc& arc) { return circle_tangent(arc.end, arc.center, arc.sweep); },
      },
      segment);
}

double length_of(const Segment& segment) {
  return std::visit(overloaded{
                        [](const Line& line) { return (line.end - line.start).norm(); },
                        [](const Arc& arc) { return std::abs(arc.sweep) * radius_of(arc); },
                    },
                    segment);
}

Segment refitted(const Arc& arc, const Point& start, const Point& end, double same_point) {
  const Vector chord = end - start;
  if (chord.norm() <= same_point) return Line{.start = start, .end = end};
  const Vector across = left_of(chord).normalized();
  const Point middle = 0.5 * (start + end);
  const Point center = middle + (arc.center - middle).dot(across) * across;
  double sweep = turn_between(start - center, end - center);
  if (sweep * arc.sweep < 0) sweep += std::copysign(2 * std::numbers::pi, arc.sweep);
  return Arc{.start = start, .end = end, .center = center, .sweep = sweep};
}

double turn_between(const Vector& a, const Vector& b) {
  const double turn = std::atan2(cross(a, b), a.dot(b));
  return turn <= -std::numbers::pi ? std::numbers::pi : turn;
}

}  // namespace trc
