#include "core/verify/part_wall.h"

namespace trc::verify {
namespace {

constexpr double point_radius = 1e-6;  // mm, of an arc that is a corner of the part

}  // namespace

PartWall part_wall(const Piece& centre_path, Side tool_side, double nominal_radius) {
  const bool left = tool_side == Side::left;
  if (!centre_path.is_arc()) {
    const Vector along = (centre_path.end - centre_path.start).normalized();
    const Vector to_part = (left ? -nominal_radius : nominal_radius) * left_of(along);
    return {.piece = {.start = centre_path.start + to_part, .end = centre_path.end + to_part}};
  }
  const bool turns_to_tool = (centre_path.sweep > 0) == left;
  const double radius = centre_path.radius();
  const double at_part = turns_to_tool ? radius + nominal_radius : radius - nominal_radius;
  if (at_part < point_radius)
    return {.piece = {.start = centre_path.center, .end = centre_path.center}, .exists = false};
  Piece wall = centre_path;
  wall.start = wall.center + (at_part / radius) * (wall.start - wall.center);
  wall.end = wall.center + (at_part / radius) * (wall.end - wall.center);
  return {.piece = wall};
}

void end_at_corner(PartWall& before, PartWall& after, Side tool_side) {
  Piece& a = before.piece;
  Piece& b = after.piece;
  if (!before.exists || !after.exists || a.is_arc() || b.is_arc()) return;
  const Vector along_a = a.end - a.start;
  const Vector along_b = b.end - b.start;
  const double turn = cross(along_a, along_b);
  if (tool_side == Side::left ? turn >= 0 : turn <= 0) return;
  const double share_a = cross(b.start - a.start, along_b) / turn;
  const double share_b = cross(b.start - a.start, along_a) / turn;
  const Point corner = a.start + share_a * along_a;
  before.exists = share_a > 0;
  after.exists = share_b < 1;
  if (before.exists && share_a < 1) a.end = corner;
  if (after.exists && share_b > 0) b.start = corner;
}

}  // namespace trc::verify
