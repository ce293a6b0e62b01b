#include "core/trc/loops/linear_transitions.h"

#include <cmath>
#include <numbers>

#include "core/geometry/parallel.h"
#include "core/trc/joints/joints.h"

namespace trc {
namespace {

enum class LegShape { line, as_curve };

Segment leg(const OffsetCurve& curve, const Point& start, const Point& end, double by,
            LegShape shape) {
  if (shape == LegShape::line || !curve.circular) return Line{.start = start, .end = end};
  return Arc{.start = start,
             .end = end,
             .center = curve.circle.center,
             .sweep = curve.counter_clockwise ? by : -by};
}

bool is_left_of(const Point& point, const Point& start, const Point& end, double slack) {
  const auto [direction, length] = directed(end - start);
  return length == 0 || cross(direction, point - start) > slack;
}

}  // namespace

bool LinearTransitions::may_replace(std::size_t piece) const {
  const auto& [block, cut] = walked_.kept(piece);
  if (cut != WalkedPath::Kept::whole || path_.is_contour(block) || path_.is_linear(block))
    return false;
  const HeldPath::Block transition = path_.block(block);
  if (transition.origin != Origin::transition || !is_arc(transition.path)) return false;
  // The circle of GEN_CIR_BLOCK_IN_CORNER belongs to inside corners.
  return !has_no_radius(transition.path) && block + 1 < path_.end() &&
         are_asked_for(path_.mode_of(block + 1));
}

void LinearTransitions::replace(std::size_t piece) {
  checkpoint_.pass();
  if (!may_replace(piece) || !are_neighbours(piece)) return;
  const std::size_t block = walked_.kept(piece).block;
  const Corner corner = corner_behind(path_.number_of(block));
  // The arc round a bow tie stays.
  if (kind_of(corner, tolerances_) != CornerKind::outside) return;
  const Joint joint = transition_joint(corner, path_.mode_of(block + 1), tolerances_);
  const auto inserted = joint.inserted();
  const bool stays = inserted.size() == 1 && is_arc(*inserted.front());
  // An arc is prolonged as an arc only if nothing is inserted.
  const bool bends = inserted.empty() && (corner.before.circular || corner.after.circular);
  if (stays || (bends && !(goes_on(block - 1) && goes_on(block + 1)))) return;
  const Replacement lines = replacement(corner, joint);
  if (!keeps_clear(block, lines) || reaches_over(corner, lines, ends_.first) ||
      reaches_over(corner, lines, ends_.last))
    return;
  path_.make_linear(block, lines.across.start, lines.across.end);
  if (joint.cut_before != 0 && goes_on(block - 1)) lengthen_before(piece - 1, joint);
  if (joint.cut_after != 0 && goes_on(block + 1)) lengthen_after(piece + 1, joint);
}

bool LinearTransitions::are_neighbours(std::size_t piece) const {
  if (piece == walked_.begin() || piece + 1 >= walked_.end()) return false;
  const std::size_t block = walked_.kept(piece).block;
  const PathPiece before = walked_[piece - 1];
  const PathPiece after = walked_[piece + 1];
  const bool goes_on_twice =
      piece + 2 < walked_.end() && walked_.kept(piece + 2).block == block + 1;
  return before.block + 1 == block && before.end == path_.ends_at(before.block) &&
         after.block == block + 1 && after.from == 0 && !after.behind_loop && !goes_on_twice;
}

bool LinearTransitions::goes_on(std::size_t block) const {
  const HeldPath::Setting& setting = path_.setting_of(block);
  return path_.is_contour(block) && setting.at_start == setting.at_end;
}

Corner LinearTransitions::corner_behind(std::size_t number) const {
  const HeldPath::ContourBlock before = path_.contour_block(number);
  const HeldPath::ContourBlock after = path_.contour_block(number + 1);
  Corner corner{.programmed = end_of(before.programmed),
                .shift = path_.setting_of(before.block).at_end.shift};
  const Vector arrives = tangent_at_end(before.programmed);
  const Vector leaves = tangent_at_start(after.programmed);
  corner.before =
      offset_curve(before.programmed, arrives,
                   parallel_point(corner.programmed, arrives, corner.shift), corner.shift);
  corner.after =
      offset_curve(after.programmed, leaves,
                   parallel_point(start_of(after.programmed), leaves, corner.shift), corner.shift);
  corner.reversal = reversal_of(corner, before.programmed, after.programmed, tolerances_);
  return corner;
}

LinearTransitions::Replacement LinearTransitions::replacement(const Corner& corner,
                                                              const Joint& joint) const {
  const auto inserted = joint.inserted();
  const Point start =
      inserted.empty() || joint.cut_before != 0 ? joint.end : end_of(*inserted.front());
  const Point end =
      inserted.empty() || joint.cut_after != 0 ? joint.start : start_of(*inserted.back());
  const LegShape shape = inserted.empty() ? LegShape::as_curve : LegShape::line;
  return {.leg_before = leg(corner.before, corner.before.anchor, start, -joint.cut_before, shape),
          .across = {.start = start, .end = end},
          .leg_after = leg(corner.after, end, corner.after.anchor, -joint.cut_after, shape)};
}

// The leg after the arc belongs to the next block, whose window reaches farther.
bool LinearTransitions::keeps_clear(std::size_t transition, const Replacement& replacement) const {
  const auto is_clear = [&](std::size_t block, const Segment& way) {
    return !obstacles_.comes_nearer(block, way, Obstacles::Nearness::passable);
  };
  return is_clear(transition, replacement.leg_before) && is_clear(transition, replacement.across) &&
         is_clear(transition + 1, replacement.leg_after);
}

bool LinearTransitions::reaches_over(const Corner& corner, const Replacement& replacement,
                                     const Point& point) const {
  const double slack = tolerances_.same_point;
  if ((point - corner.programmed).norm() <= corner.tool_radius() + slack) return false;
  const Point places[] = {corner.before.anchor, replacement.across.start, replacement.across.end,
                          corner.after.anchor};
  // Left of the contour the tool goes round the corner clockwise: points outside lie to the left.
  const double side = corner.shift > 0 ? 1 : -1;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Point& start = side > 0 ? places[leg + 1] : places[leg];
    const Point& end = side > 0 ? places[leg] : places[leg + 1];
    if (!is_left_of(point, start, end, slack)) return false;
  }
  // And on this side of the chord.
  return side > 0 ? is_left_of(point, places[0], places[3], slack)
                  : is_left_of(point, places[3], places[0], slack);
}

void LinearTransitions::lengthen_before(std::size_t piece, const Joint& joint) {
  const auto& [block, cut] = walked_.kept(piece);
  path_.lengthen_end(block, joint.end, -joint.cut_before);
  if (cut == WalkedPath::Kept::whole) return;
  PathPiece& part = walked_.cut(cut);
  part.to = length_of(path_.block(block).path);
  part.end = joint.end;
}

void LinearTransitions::lengthen_after(std::size_t piece, const Joint& joint) {
  const auto& [block, cut] = walked_.kept(piece);
  const double before = length_of(path_.block(block).path);
  path_.lengthen_start(block, joint.start, -joint.cut_after);
  if (cut == WalkedPath::Kept::whole) return;
  PathPiece& part = walked_.cut(cut);
  const double length = length_of(path_.block(block).path);
  part.to = part.to == before ? length : part.to + (length - before);
  part.start = joint.start;
}

}  // namespace trc
