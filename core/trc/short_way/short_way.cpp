#include "core/trc/short_way/short_way.h"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "core/base/flatten.h"
#include "core/geometry/parallel.h"
#include "core/trc/corner/bow_tie.h"
#include "core/trc/corner/offsets.h"
#include "core/trc/passes/rounded_input.h"
#include "core/trc/short_way/plain_blocks.h"

namespace trc {

using Reach = HeldPath::Reach;

bool ShortWay::may_begin(const PathBlock& open, const PathBlock& held) const {
  const bool removes_loops = goes_into_loop_removal();
  return (removes_loops ? into_loop_removal_.takes_more_like(held) : !inverse_path_) &&
         held.removes_loops() == removes_loops && is_plain(open) && is_plain(held) &&
         open.at_end == held.at_end && open.programmed.mode == held.programmed.mode &&
         is_plain(held.mode(), removes_loops ? Loops::removed : Loops::kept);
}

std::size_t ShortWay::take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                           std::vector<CompensatedBlock>& out) {
  begin(held);
  std::array<Corner, 2> corners;
  std::array<ShortStep, 2> steps;
  for (Corner& corner : corners) corner.shift = shift_;
  Corner* corner = corners.data();
  Corner* next_corner = &corners[1];
  ShortStep* before = steps.data();
  ShortStep* after = &steps[1];
  offset(open.programmed, *before, *next_corner, *corner);
  before->tool_start = open.tool_start;
  before->cut_at_start = open.cut_at_start;
  MotionBlock* last = &held.programmed;
  const MotionBlock* put_out = nullptr;
  std::size_t count = 0;
  for (Block& block : blocks) {
    auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || !takes(*motion)) break;
    offset(*last, *after, *corner, *next_corner);
    if (!join({*corner, *before, *after}, out)) break;
    put_out = before->programmed;
    std::swap(before, after);
    std::swap(corner, next_corner);
    last = motion;
    ++count;
  }
  if (count == 0) return 0;
  last_out_ = put_out->path;
  open.programmed = std::move(*before->programmed);
  give_offsets(open);
  open.tool_start = before->tool_start;
  open.cut_at_start = before->cut_at_start;
  open.unreachable = before->unreachable;
  held.programmed = std::move(*last);
  return count;
}

void ShortWay::begin(const PathBlock& held) {
  mode_ = held.programmed.mode.get();
  shift_ = held.at_end.shift;
  loops_ = held.removes_loops() ? Loops::removed : Loops::kept;
  if (loops_ == Loops::kept) return;
  exact_ = to_all_digits(tolerances_, std::abs(shift_));
  into_loop_removal_.begin_run();
}

bool ShortWay::takes(const MotionBlock& block) const {
  return block.mode.get() == mode_ && !RoundedInput::is_short(block, input_resolution_) &&
         (loops_ == Loops::kept || into_loop_removal_.goes_on());
}

void ShortWay::offset(MotionBlock& programmed, ShortStep& step, Corner& begin, Corner& end) const {
  OffsetCurve& first = begin.after;
  OffsetCurve& last = end.before;
  step.programmed = &programmed;
  if (const auto* arc = std::get_if<Arc>(&programmed.path)) {
    const auto [radial, radius] = directed(arc->start - arc->center);
    const Vector start_tangent = tangent_across(radial, *arc);
    const Vector end_tangent = tangent_at(arc->end, *arc);
    first = offset_curve(*arc, radius, start_tangent,
                         parallel_point(arc->start, start_tangent, shift_), shift_);
    last = offset_curve(*arc, radius, end_tangent, parallel_point(arc->end, end_tangent, shift_),
                        shift_);
    end.programmed = arc->end;
    step.length = std::abs(arc->sweep) * radius;
    step.extent = std::abs(arc->sweep);
    step.radius = radius;
    step.unreachable =
        loops_ == Loops::removed && is_unreachable(first.circle.radius, shift_, tolerances_);
  } else {
    const Line& line = std::get<Line>(programmed.path);
    const auto [tangent, length] = directed(line.end - line.start);
    first = {.anchor = parallel_point(line.start, tangent, shift_), .tangent = tangent};
    last = {.anchor = parallel_point(line.end, tangent, shift_), .tangent = tangent};
    end.programmed = line.end;
    step.length = step.extent = length;
    step.radius = 1;
    step.unreachable = false;
  }
  step.tangent_at_start = first.tangent;
}

// The rules between contour blocks (rule 4.2), as in joint_between(). Inlined in one piece: the
// steps take less time than their calls.
TRC_FLATTEN bool ShortWay::join(const AtCorner& at, std::vector<CompensatedBlock>& out) {
  const Corner& corner = at.corner;
  if (loops_ == Loops::kept && corner.after.circular &&
      vanishes(corner.after.circle.radius, tolerances_))
    return false;
  // The corner alone does not tell a tip from a slit.
  if (may_reverse(corner)) return false;
  switch (kind_of(corner, tolerances_)) {
    case CornerKind::tangential:
      return leave(at, tangential_joint(corner), Reach::reachable, out);
    case CornerKind::outside:
      return leave(at, outside_joint(corner, transition_rule(*mode_, loops_), tolerances_),
                   Reach::reachable, out);
    case CornerKind::inside:
      return join_inside(at, out);
  }
  return false;
}

bool ShortWay::join_inside(const AtCorner& at, std::vector<CompensatedBlock>& out) {
  const auto& [corner, before, after] = at;
  if (loops_ == Loops::kept) {
    const auto meeting = inside_joint(corner, tolerances_);
    return meeting && leave(at, Joint(*meeting), Reach::reachable, out);
  }
  // The block after the short one decides whether this is a bow tie.
  const double largest = largest_bow_tie(tolerances_.input_resolution, std::abs(shift_));
  if (after.length <= longest_in_bow_tie(largest)) return false;
  const bool vanished = before.unreachable || after.unreachable;
  const auto meeting =
      vanished ? std::nullopt : inside_joint_on_blocks(corner, before.extent, after.extent, exact_);
  return meeting ? leave(at, Joint(*meeting), Reach::reachable, out)
                 : leave(at, joint_across(corner.before.anchor, corner.after.anchor),
                         Reach::unreachable, out);
}

bool ShortWay::leave(const AtCorner& at, const Joint& joint, Reach inserted,
                     std::vector<CompensatedBlock>& out) {
  at.after.tool_start = joint.start;
  at.after.cut_at_start = joint.cut_after;
  if (loops_ == Loops::kept) return into_result_.put_out(at, joint, out);
  into_loop_removal_.take(at, joint, inserted, out);
  return true;
}

}  // namespace trc
