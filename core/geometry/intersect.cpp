#include "core/geometry/intersect.h"

#include <algorithm>
#include <cmath>

namespace trc {

Meetings intersect(const StraightLine& a, const StraightLine& b) {
  Meetings meetings;
  const double sine = cross(a.direction, b.direction);
  if (sine == 0) return meetings;
  const double along = cross(b.point - a.point, b.direction) / sine;
  meetings.add(a.point + along * a.direction);
  return meetings;
}

Meetings intersect(const StraightLine& line, const Circle& circle, double same_point) {
  Meetings meetings;
  const Vector to_center = circle.center - line.point;
  const double along = to_center.dot(line.direction);
  const double aside = std::abs(cross(line.direction, to_center));
  if (aside > circle.radius + same_point) return meetings;
  const Point foot = line.point + along * line.direction;
  // The product form keeps the digits that radius^2 - aside^2 would lose.
  const double half_chord =
      std::sqrt(std::max(0.0, (circle.radius - aside) * (circle.radius + aside)));
  meetings.add(foot - half_chord * line.direction);
  if (half_chord > 0) meetings.add(foot + half_chord * line.direction);
  return meetings;
}

Meetings intersect(const Circle& a, const Circle& b, double same_point) {
  Meetings meetings;
  const Vector between = b.center - a.center;
  const double distance = between.norm();
  if (distance == 0) return meetings;
  const double apart = distance - a.radius - b.radius;
  const double nested = std::abs(a.radius - b.radius) - distance;
  if (apart > same_point || nested > same_point) return meetings;
  const Vector axis = between / distance;
  // Measured from the centre of the smaller circle: the difference to a large radius
  // would lose its last digits.
  const bool from_second = b.radius < a.radius;
  const Circle& small = from_second ? b : a;
  const Circle& large = from_second ? a : b;
  const double along =
      0.5 * (distance + (small.radius - large.radius) * ((small.radius + large.radius) / distance));
  const double half_chord =
      std::sqrt(std::max(0.0, (small.radius - std::abs(along)) * (small.radius + std::abs(along))));
  if (half_chord == 0) {
    meetings.add(a.center + std::copysign(a.radius, from_second ? 1 : along) * axis);
    return meetings;
  }
  const Point foot = small.center + (from_second ? -along : along) * axis;
  meetings.add(foot - half_chord * left_of(axis));
  meetings.add(foot + half_chord * left_of(axis));
  return meetings;
}

}  // namespace trc
