#include "core/verify/capsule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trc::verify {

Capsule capsule_of(const Piece& piece) {
  const Vector chord = piece.end - piece.start;
  const double length = magnitude(chord);
  Capsule capsule{
      .center = 0.5 * (piece.start + piece.end), .half = 0.5 * chord, .half_length = 0.5 * length};
  if (length > 0) capsule.normal = left_of(chord) / length;
  if (!piece.is_arc()) return capsule;
  const double radius = piece.radius();
  const double end_radius = magnitude(piece.end - piece.center);
  const double largest = std::max(radius, end_radius);
  if (std::abs(piece.sweep) > std::numbers::pi || length == 0)
    return {.center = piece.center, .margin = largest};
  // The bow lies on the right of the chord where the arc turns left. Start and end may lie on
  // circles that differ a little, so that it reaches beyond the chord by that.
  const Vector bow = std::copysign(1.0, -piece.sweep) * capsule.normal;
  const double height = rise_of(piece, largest, bow);
  capsule.center += 0.5 * height * bow;
  capsule.margin = height / 2 + 2 * std::abs(radius - end_radius);
  return capsule;
}

}  // namespace trc::verify
