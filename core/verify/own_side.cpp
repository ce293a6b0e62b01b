#include "core/verify/own_side.h"

#include <cmath>
#include <numbers>

#include "core/verify/nearest.h"
#include "core/verify/shape.h"

namespace trc::verify {
namespace {

// Decides for two lines, and for arcs about one centre if the path covers no more than the contour.
bool is_surely_beside(const Piece& path, const Piece& own, Side side) {
  if (path.is_arc() != own.is_arc()) return false;
  if (!path.is_arc()) {
    const Point middle = 0.5 * (path.start + path.end);
    const double left = cross(Vector(own.end - own.start), middle - own.start);
    return side == Side::left ? left >= 0 : left <= 0;
  }
  const bool turns_left = own.sweep > 0;
  if (path.center != own.center || (path.sweep > 0) != turns_left ||
      std::abs(own.sweep) > std::numbers::pi)
    return false;
  const bool is_inside =
      (path.start - path.center).squaredNorm() < (own.start - own.center).squaredNorm();
  return is_inside == (turns_left == (side == Side::left)) && is_within(path, own);
}

}  // namespace

std::optional<WrongSide> on_wrong_side(const Piece& path, const Piece& own, Side side) {
  // The quick test; a piece that it finds at fault is examined like all others.
  if (is_surely_beside(path, own, side)) return std::nullopt;
  const Point middle = place_at(segment_of(path), 0.5).point;
  const Segment contour = segment_of(own);
  const Point foot = nearest_point(contour, middle);
  const double left = cross(direction_at(contour, foot), middle - foot);
  if (side == Side::left ? left >= 0 : left <= 0) return std::nullopt;
  return WrongSide{.middle = middle, .apart = (middle - foot).norm()};
}

}  // namespace trc::verify
