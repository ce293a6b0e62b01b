#include "core/verify/piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace trc::verify {

Piece piece_of(const Segment& segment) {
  if (const auto* arc = std::get_if<Arc>(&segment))
    return {.start = arc->start, .end = arc->end, .center = arc->center, .sweep = arc->sweep};
  const Line& line = std::get<Line>(segment);
  return {.start = line.start, .end = line.end};
}

Segment segment_of(const Piece& piece) {
  if (piece.is_arc())
    return Arc{
        .start = piece.start, .end = piece.end, .center = piece.center, .sweep = piece.sweep};
  return Line{.start = piece.start, .end = piece.end};
}

Box box_of(const Piece& piece) {
  const Vector chord = piece.end - piece.start;
  const double length = magnitude(chord);
  Box box{.center = 0.5 * (piece.start + piece.end), .half = {length / 2, 0}};
  if (length > 0) box.along = chord / length;
  if (!piece.is_arc()) return box;
  // Start and end may lie on circles that differ a little.
  const double start_radius = piece.radius();
  const double end_radius = magnitude(piece.end - piece.center);
  const double radius = std::max(start_radius, end_radius);
  if (std::abs(piece.sweep) > std::numbers::pi || length == 0)
    return {.center = piece.center, .half = {radius, radius}};
  // The bow lies on the right of the chord if the arc turns left.
  const Vector bow = std::copysign(1.0, -piece.sweep) * left_of(box.along);
  const double height = rise_of(piece, radius, bow);
  const double misfit = std::abs(start_radius - end_radius);
  box.center += 0.5 * height * bow;
  box.half += Vector(misfit, height / 2 + misfit);
  return box;
}

Ring ring_of(const Piece& piece, const Point& center) {
  if (!piece.is_arc()) {
    const Vector along = piece.end - piece.start;
    const Vector start = piece.start - center;
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp(-start.dot(along) / square, 0.0, 1.0) : 0;
    return {.center = center,
            .inner = magnitude(start + share * along),
            .outer = std::sqrt(std::max(start.squaredNorm(), (piece.end - center).squaredNorm()))};
  }
  const Vector from = piece.start - piece.center;
  const Vector to = piece.end - piece.center;
  const double radius = magnitude(from);
  const double end_radius = magnitude(to);
  const double low = std::min(radius, end_radius);
  const double high = std::max(radius, end_radius);
  // The nearest point of its circle lies towards `center`, the farthest one away from it. If the
  // arc does not pass such a point, one of its ends takes its place.
  const Vector toward = center - piece.center;
  const Vector& first = piece.sweep > 0 ? from : to;
  const Vector& last = piece.sweep > 0 ? to : from;
  const bool is_minor = std::abs(piece.sweep) <= std::numbers::pi;
  const auto may_pass = [&](const Vector& out) {
    return !is_minor || (cross(first, out) >= 0 && cross(out, last) >= 0);
  };
  const bool may_be_nearest = may_pass(toward);
  const bool may_be_farthest = may_pass(-toward);
  Ring ring{.center = center};
  if (may_be_nearest || may_be_farthest) {
    const double apart = magnitude(toward);
    ring.inner = std::max({0.0, apart - high, low - apart});
    ring.outer = apart + high;
  }
  if (may_be_nearest && may_be_farthest) return ring;
  const double start_square = (piece.start - center).squaredNorm();
  const double end_square = (piece.end - center).squaredNorm();
  if (!may_be_nearest)
    ring.inner = std::max(0.0, std::sqrt(std::min(start_square, end_square)) - (high - low));
  if (!may_be_farthest) ring.outer = std::sqrt(std::max(start_square, end_square)) + (high - low);
  return ring;
}

}  // namespace trc::verify
