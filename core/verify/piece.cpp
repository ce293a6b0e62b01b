#include "core/verify/piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "core/verify/nearest.h"

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
  const double radius = std::max(piece.radius(), (piece.end - piece.center).norm());
  if (std::abs(piece.sweep) > std::numbers::pi)
    return {.center = piece.center, .half = {radius, radius}};
  const double quarter = std::sin(piece.sweep / 4);
  const double height = 2 * radius * quarter * quarter;
  const double misfit = std::abs(piece.radius() - (piece.end - piece.center).norm());
  // The bow lies on the right of the chord where the arc turns left.
  box.center -= std::copysign(height / 2, piece.sweep) * left_of(box.along);
  box.half += Vector(misfit, height / 2 + misfit);
  return box;
}

Ring ring_of(const Piece& piece, const Point& center) {
  if (!piece.is_arc()) {
    const Line line{.start = piece.start, .end = piece.end};
    const double nearest = (nearest_point(line, center) - center).norm();
    return {.center = center,
            .inner = nearest,
            .outer = std::sqrt(
                std::max((line.start - center).squaredNorm(), (line.end - center).squaredNorm()))};
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
