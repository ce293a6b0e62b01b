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
  const double length = chord.norm();
  Box box{.center = 0.5 * (piece.start + piece.end), .half = {length / 2, 0}};
  if (length > 0) box.along = chord / length;
  if (!piece.is_arc()) return box;
  // Start and end may lie on circles that differ a little.
  const double start_radius = piece.radius();
  const double end_radius = (piece.end - piece.center).norm();
  const double radius = std::max(start_radius, end_radius);
  if (std::abs(piece.sweep) > std::numbers::pi || length == 0)
    return {.center = piece.center, .half = {radius, radius}};
  // The bow lies on the right of the chord where the arc turns left.
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
            .inner = Vector(start + share * along).norm(),
            .outer = std::sqrt(std::max(start.squaredNorm(), (piece.end - center).squaredNorm()))};
  }
  const double apart = (piece.center - center).norm();
  const double radius = piece.radius();
  const double end_radius = (piece.end - piece.center).norm();
  const double low = std::min(radius, end_radius);
  const double high = std::max(radius, end_radius);
  return {
      .center = center, .inner = std::max({0.0, apart - high, low - apart}), .outer = apart + high};
}

}  // namespace trc::verify
