#include "core/trc/joints/joints.h"

#include <cmath>
#include <numbers>

#include "core/geometry/parallel.h"
#include "core/trc/selection/direct.h"
#include "core/trc/selection/on_path.h"
#include "core/trc/selection/tangential.h"

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

OffsetCurve straight(const Point& anchor, const Vector& tangent) {
  return {.anchor = anchor, .tangent = tangent};
}

JointResult on_path(const std::optional<Joint>& joint, Role role, const Corner& corner) {
  if (joint) return JoinedBlocks{.joint = *joint};
  return JointRefusal{.code = Code::selection_block_too_short,
                      .of_after = role == Role::retract,
                      .place = corner.programmed};
}

// The corner with a way in place of its first block, or of its second one for a retract. The way
// comes from `far`, or leads there, along a tangent of the circle about the corner. Empty if `far`
// is inside the circle.
std::optional<Corner> corner_touched_from(const Point& far, const Corner& corner, Role role) {
  const bool leaves = role == Role::retract;
  const Vector way = leaves ? far - corner.programmed : corner.programmed - far;
  const double length = way.norm();
  if (length < corner.tool_radius() || length == 0) return std::nullopt;
  const double sine = (leaves ? -corner.shift : corner.shift) / length;
  const Vector along = way / length;
  const Vector tangent = std::sqrt(1 - sine * sine) * along + sine * left_of(along);
  Corner touched = corner;
  (leaves ? touched.after : touched.before) =
      straight(parallel_point(corner.programmed, tangent, corner.shift), tangent);
  touched.reversal = Reversal::none;
  return touched;
}

// KONT, at an outside corner. The way turns further than the programmed one: the tool may go more
// than half round the corner, which lines cannot do.
JointResult round_by_tangent(const Point& far, const Corner& corner, const TrcMode& mode, Role role,
                             const Tolerances& tolerances) {
  const auto touched = corner_touched_from(far, corner, role);
  if (!touched) return on_path({}, role, corner);
  const bool more_than_half = touched->sine_of_turn() * corner.shift > 0;
  if (!more_than_half) return JoinedBlocks{.joint = transition_joint(*touched, mode, tolerances)};
  const double turn = touched->turn();
  Joint joint;
  joint.end = touched->before.anchor;
  joint.start = touched->after.anchor;
  joint.insert(Arc{.start = joint.end,
                   .end = joint.start,
                   .center = corner.programmed,
                   .sweep = turn > 0 ? turn - 2 * pi : turn + 2 * pi});
  return JoinedBlocks{.joint = joint};
}

JointResult approach(const PathBlock& before, const PathBlock& after, const Corner& corner,
                     const Tolerances& tolerances) {
  // The mode of the selection block; the block after the corner decides the transition (D-149).
  const TrcMode& mode = before.mode();
  if (mode.becomes_arc()) {
    auto path = selection::tangential_entry(start_of(before.programmed.path), corner.after.anchor,
                                            corner.after.tangent, tolerances);
    if (path) return JoinedBlocks{selection::approach_direct(corner), path};
    return JointRefusal{.code = Code::tangential_start_on_tangent, .place = before.tool_start};
  }
  switch (mode.selection) {
    case Selection::indirect:
      if (kind_of(corner, tolerances) != CornerKind::outside) break;
      if (mode.touches_corner_circle)
        return round_by_tangent(start_of(before.programmed.path), corner, after.mode(),
                                Role::approach, tolerances);
      return JoinedBlocks{.joint = transition_joint(corner, after.mode(), tolerances)};
    case Selection::on_path:
      return on_path(
          selection::approach_on_path(corner, before.programmed.path, before.tangent_at_end,
                                      selection::around_corner(mode), tolerances),
          Role::approach, corner);
    case Selection::perpendicular:
      return JoinedBlocks{.joint = joint_across(corner.programmed, corner.after.anchor)};
    case Selection::inside_corner: {
      Joint joint;
      joint.end = joint.start = before.offset_end;
      joint.cut_after = before.cut_at_end;
      return JoinedBlocks{.joint = joint};
    }
    case Selection::direct:
    case Selection::without_block:
      break;
  }
  return JoinedBlocks{.joint = selection::approach_direct(corner)};
}

JointResult retract(const PathBlock& after, Selection mode, const Corner& corner,
                    const Tolerances& tolerances) {
  if (after.mode().becomes_arc()) {
    const Point& target = end_of(after.programmed.path);
    auto path =
        selection::tangential_exit(corner.before.anchor, corner.before.tangent, target, tolerances);
    if (path) return JoinedBlocks{selection::retract_direct(corner), path};
    return JointRefusal{
        .code = Code::tangential_start_on_tangent, .of_after = true, .place = target};
  }
  switch (mode) {
    case Selection::indirect:
      if (kind_of(corner, tolerances) != CornerKind::outside) break;
      if (after.mode().touches_corner_circle && after.role == Role::retract)
        return round_by_tangent(end_of(after.programmed.path), corner, after.mode(), Role::retract,
                                tolerances);
      return JoinedBlocks{.joint = transition_joint(corner, after.mode(), tolerances)};
    case Selection::on_path:
      return on_path(
          selection::retract_on_path(corner, after.programmed.path, after.tangent_at_start,
                                     selection::around_corner(after.mode()), tolerances),
          Role::retract, corner);
    case Selection::perpendicular:
      return JoinedBlocks{.joint = joint_across(corner.before.anchor, corner.programmed)};
    case Selection::inside_corner: {
      Joint joint;
      joint.end = joint.start = after.offset_start;
      joint.cut_before = after.cut_at_start;
      return JoinedBlocks{.joint = joint};
    }
    case Selection::direct:
    case Selection::without_block:
      break;
  }
  return JoinedBlocks{.joint = selection::retract_direct(corner)};
}

JointResult contour_joint(const PathBlock& before, const PathBlock& after, const Corner& corner,
                          const Tolerances& tolerances) {
  const TrcMode& mode = after.mode();
  const bool vanished = before.unreachable || after.unreachable;
  switch (kind_of(corner, tolerances)) {
    case CornerKind::tangential:
      return JoinedBlocks{.joint = tangential_joint(corner)};
    case CornerKind::outside:
      return JoinedBlocks{
          .joint = after.removes_loops()
                       ? outside_joint(corner, transition_rule(mode, Loops::removed), tolerances)
                       : transition_joint(corner, mode, tolerances)};
    case CornerKind::inside:
      break;
  }
  std::optional<MeetingPoint> meeting;
  if (after.removes_loops()) {
    if (!vanished)
      meeting = inside_joint_on_blocks(corner, extent_of(before.programmed.path),
                                       extent_of(after.programmed.path),
                                       to_all_digits(tolerances, corner.tool_radius()));
    if (!meeting)
      return JoinedBlocks{.joint = joint_across(corner.before.anchor, corner.after.anchor),
                          .gap = true};
  } else if (!vanished) {
    meeting = inside_joint(corner, tolerances);
  }
  if (meeting) {
    Joint joint(*meeting);
    if (mode.options.gen_cir_block_in_corner)
      joint.insert(
          Arc{.start = joint.end, .end = joint.start, .center = joint.end, .sweep = corner.turn()});
    return JoinedBlocks{.joint = joint};
  }
  if (mode.options.ignore_cont_damage)
    return JoinedBlocks{.joint = joint_across(corner.before.anchor, corner.after.anchor)};
  const bool line_before = !corner.before.circular;
  const bool line = line_before || !corner.after.circular;
  return JointRefusal{.code = line ? Code::line_reversed : Code::arc_wrapped,
                      .of_after = !line_before,
                      .place = corner.programmed};
}

}  // namespace

Joint transition_joint(const Corner& corner, const TrcMode& mode, const Tolerances& tolerances) {
  const double limit = pi + pi / 180 + tolerances.tangent;
  const bool extensible = corner.before.exists() && corner.after.exists();
  if (mode.options.ext_angle_block_intersection && extensible &&
      transition_angle(corner, tolerances) <= limit) {
    if (auto joint = extended_joint(corner, tolerances)) return *joint;
  }
  return outside_joint(corner, transition_rule(mode, Loops::kept), tolerances);
}

Corner corner_between(const PathBlock& before, const PathBlock& after,
                      const Tolerances& tolerances) {
  Corner corner{.programmed = end_of(before.programmed.path)};
  corner.shift = before.at_end.shift;
  // Off the contour the blocks count as straight: their own shape has no offset.
  corner.before = is_contour(before) ? offset_curve(before.programmed.path, before.tangent_at_end,
                                                    before.offset_end, corner.shift)
                                     : straight(before.offset_end, before.tangent_at_end);
  corner.after = is_contour(after) ? offset_curve(after.programmed.path, after.tangent_at_start,
                                                  after.offset_start, corner.shift)
                                   : straight(after.offset_start, after.tangent_at_start);
  corner.reversal = after.behind_tip ? Reversal::tip
                                     : reversal_of(corner, before.programmed.path,
                                                   after.programmed.path, tolerances);
  return corner;
}

JointResult joint_between(const PathBlock& before, const PathBlock& after, const Corner& corner,
                          const Tolerances& tolerances) {
  // REVERSE: at a reversal both equidistants end in one point (rule 9, D-141), at any other corner
  // the tool goes straight across it (D-22).
  if (is_contour(before) && is_contour(after) && before.at_end.shift * after.at_start.shift < 0)
    return JoinedBlocks{.joint = turns_back(corner.before.tangent, corner.after.tangent, tolerances)
                                     ? tangential_joint(corner)
                                     : joint_across(corner.before.anchor, corner.after.anchor)};
  if (!is_contour(before)) return approach(before, after, corner, tolerances);
  if (after.role == Role::retract)
    return retract(after, after.mode().deselection, corner, tolerances);
  if (after.role == Role::side_change)
    return retract(after, after.mode().selection, corner, tolerances);
  return contour_joint(before, after, corner, tolerances);
}

double left_of_block(const PathBlock& block, double cut_at_start, double cut_at_end) {
  return extent_of(block.programmed.path) - cut_at_start - cut_at_end;
}

}  // namespace trc
