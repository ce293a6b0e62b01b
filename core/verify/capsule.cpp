#include "core/verify/capsule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trc::verify {

Capsule capsule_of_arc(const Piece& arc) {
  const Vector chord = arc.end - arc.start;
  const double length = magnitude(chord);
  const double radius = arc.radius();
  const double end_radius = magnitude(arc.end - arc.center);
  const double largest = std::max(radius, end_radius);
  if (std::abs(arc.sweep) > std::numbers::pi || length == 0)
    return {.center = arc.center, .margin = largest};
  // The bow lies on the right of the chord if the arc turns left. Start and end may lie on circles
  // that differ a little, and the bow may reach beyond the chord by the difference.
  const Vector bow = left_of(chord) * (std::copysign(1.0, -arc.sweep) / length);
  const double height = rise_of(arc, largest, bow);
  return {.center = 0.5 * (arc.start + arc.end) + 0.5 * height * bow,
          .half = 0.5 * chord,
          .margin = height / 2 + 2 * std::abs(radius - end_radius)};
}

}  // namespace trc::verify
