#include "core/trc/short_way/short_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/base/flatten.h"
#include "core/geometry/parallel.h"
#include "core/trc/corner/bow_tie.h"
#include "core/trc/corner/tool_path.h"
#include "core/trc/passes/contour_violations.h"
#include "core/trc/passes/offset.h"
#include "core/trc/passes/rounded_input.h"

namespace trc {
namespace {

// Whether the short way knows all the options that are on. Each one is named: a new one does not
// compile until it is decided what it means here. Those marked so change nothing between two blocks
// in the middle of a contour, or are asked for where they do.
bool knows(const TrcOptions& options, bool removes_loops) {
  [[maybe_unused]] const auto& [conv_cir_to_lin, kerf_masking, reverse /* at a change of side */,
                                ignore_cont_damage, remove_masked_blocks /* removes_loops */,
                                ext_angle_block_intersection, g236_lin /* at the ends */,
                                stretch_factor /* asked for */, tangential_limit /* Reporting */,
                                perpendicular_radius_change /* at a change of radius */,
                                gen_cir_block_in_corner, suppress_trc /* the shift */, inverse,
                                split /* at the ends */] = options;
  return !conv_cir_to_lin && !kerf_masking && !ext_angle_block_intersection &&
         !gen_cir_block_in_corner && !inverse && (removes_loops || !ignore_cont_damage);
}

bool is_plain(const TrcMode& mode, bool removes_loops) {
  [[maybe_unused]] const auto& [plane, side /* the shift */, tool_radius /* the shift */,
                                nominal_radius, below_nominal, selection_number,
                                selection /* at the ends */, deselection /* at the ends */,
                                tangential /* at the ends */,
                                touches_corner_circle /* at the ends */, transition /* asked for */,
                                masking, feed_adaptation, tangfeed_minimum /* of feed_adaptation */,
                                options] = mode;
  const bool adapts = masking == Masking::on || feed_adaptation != FeedAdaptation::off;
  // Transitions tells how deep a smaller tool of wear mode reaches.
  return knows(options, removes_loops) && (removes_loops || !adapts) && !below_nominal;
}

// In the middle of a contour, under one compensation, and nothing else.
bool is_plain(const PathBlock& block) {
  return block.role == Role::contour && block.origin == Origin::programmed &&
         block.at_start == block.at_end && !block.perpendicular_entry &&
         !block.perpendicular_exit && !block.path_given && !block.masked && !block.rejoin &&
         !block.unreachable && !block.behind_tip && block.passive.empty() &&
         block.passive_after_exit.empty();
}

}  // namespace

bool ShortWay::may_begin(const PathBlock& open, const PathBlock& held) const {
  const bool removes_loops = loop_removal_.takes_contour();
  return (removes_loops ? loop_removal_.takes_more_like(held) : !inverse_path_) &&
         held.removes_loops() == removes_loops && is_plain(open) && is_plain(held) &&
         open.at_end == held.at_end && open.programmed.mode == held.programmed.mode &&
         is_plain(held.mode(), removes_loops);
}

std::size_t ShortWay::take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                           std::vector<CompensatedBlock>& out) {
  begin(held);
  std::array<Corner, 2> corners;
  std::array<Step, 2> steps;
  for (Corner& corner : corners) corner.shift = shift_;
  Corner* corner = corners.data();
  Corner* next_corner = &corners[1];
  Step* before = steps.data();
  Step* after = &steps[1];
  offset(open.programmed, *before, *next_corner, *corner);
  before->tool_start = open.tool_start;
  before->cut_at_start = open.cut_at_start;
  MotionBlock* last = &held.programmed;
  const MotionBlock* put_out = nullptr;
  std::size_t count = 0;
  for (Block& block : blocks) {
    auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || motion->mode.get() != mode_ || !going_) break;
    if (RoundedInput::is_short(*motion, input_resolution_)) break;
    offset(*last, *after, *corner, *next_corner);
    const OffsetCurve& equidistant = corner->after;
    if (!removes_loops_ && equidistant.circular && vanishes(equidistant.circle.radius, tolerances_))
      break;
    if (!join(*corner, *before, *after, out)) break;
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
  going_ = true;
  removes_loops_ = held.removes_loops();
  if (!removes_loops_) return;
  exact_ = to_all_digits(tolerances_, std::abs(shift_));
  loop_removal_.go_on_like_last();
}

void ShortWay::offset(MotionBlock& programmed, Step& step, Corner& begin, Corner& end) const {
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
    step.unreachable = removes_loops_ && is_unreachable(first.circle.radius, shift_, tolerances_);
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

// The rules between contour blocks (rule 4.2) as joint_between() has them for such blocks. In one
// piece: what is done from here on takes less than to call it step by step.
TRC_FLATTEN bool ShortWay::join(const Corner& corner, const Step& before, Step& after,
                                std::vector<CompensatedBlock>& out) {
  // Which kind of corner that is takes more than the corner.
  if (may_reverse(corner)) return false;
  switch (kind_of(corner, tolerances_)) {
    case CornerKind::tangential:
      return leave(corner, tangential_joint(corner), false, before, after, out);
    case CornerKind::outside:
      return leave(
          corner,
          outside_joint(corner,
                        transition_rule(*mode_, removes_loops_ ? Loops::removed : Loops::kept),
                        tolerances_),
          false, before, after, out);
    case CornerKind::inside:
      break;
  }
  // What it is depends on the block behind.
  if (removes_loops_ && after.length <= longest_in_bow_tie(largest_bow_tie(
                                            tolerances_.input_resolution, std::abs(shift_))))
    return false;
  return join_inside(corner, before, after, out);
}

bool ShortWay::join_inside(const Corner& corner, const Step& before, Step& after,
                           std::vector<CompensatedBlock>& out) {
  if (!removes_loops_) {
    const auto meeting = inside_joint(corner, tolerances_);
    return meeting && leave(corner, Joint(*meeting), false, before, after, out);
  }
  const bool vanished = before.unreachable || after.unreachable;
  const auto meeting =
      vanished ? std::nullopt : inside_joint_on_blocks(corner, before.extent, after.extent, exact_);
  return meeting ? leave(corner, Joint(*meeting), false, before, after, out)
                 : leave(corner, joint_across(corner.before.anchor, corner.after.anchor), true,
                         before, after, out);
}

bool ShortWay::leave(const Corner& corner, const Joint& joint, bool gap, const Step& before,
                     Step& after, std::vector<CompensatedBlock>& out) {
  after.tool_start = joint.start;
  after.cut_at_start = joint.cut_after;
  if (removes_loops_) {
    hold(corner, joint, gap, before, after);
    if (loop_removal_.look_ahead() > 0) put_out_leaving(out);
    return true;
  }
  for (const auto& inserted : joint.inserted())
    if (out_of_range(*inserted, tolerances_)) return false;
  return put_out(corner, joint, before, after, out);
}

// Does nothing where the block is a contour violation.
bool ShortWay::put_out(const Corner& corner, const Joint& joint, const Step& before,
                       const Step& after, std::vector<CompensatedBlock>& out) {
  if (const auto* arc = std::get_if<Arc>(&before.programmed->path)) {
    const double left = before.extent - before.cut_at_start - joint.cut_before;
    if (is_consumed(left, corner.before.circle.radius, tolerances_)) return false;
    return put_out(
        shortened(*arc, {before.tool_start, joint.end, left}, Consumed::wraps_round, tolerances_),
        joint, before, after, out);
  }
  const Line path{.start = before.tool_start, .end = joint.end};
  return !runs_back(path.end - path.start, corner.before.tangent, tolerances_) &&
         put_out(path, joint, before, after, out);
}

template <class Path>
bool ShortWay::put_out(const Path& path, const Joint& joint, const Step& before, const Step& after,
                       std::vector<CompensatedBlock>& out) {
  if (out_of_range(path, tolerances_)) return false;
  MotionBlock& programmed = *before.programmed;
  reporting_.summary().programmed_length += before.length;
  const auto inserted = joint.inserted();
  // Before its tracking axes go with the block.
  if (!inserted.empty()) insert_behind(programmed, *after.programmed, inserted_);
  reporting_.put_out(programmed, *mode_, Origin::programmed, path, out);
  for (const auto& segment : inserted) {
    const TrackingTravel tracking = inserted_.tracking;
    reporting_.put_out(inserted_, *mode_, Origin::transition, *segment, out);
    inserted_.tracking = tracking;
  }
  return true;
}

TRC_FLATTEN [[gnu::noinline]] void ShortWay::hold(const Corner& corner, const Joint& joint,
                                                  bool gap, const Step& before, const Step& after) {
  const HeldPath::Cuts cuts{before.cut_at_start, joint.cut_before};
  if (const auto* arc = std::get_if<Arc>(&before.programmed->path)) {
    const double left = before.extent - cuts.at_start - cuts.at_end;
    std::visit(
        [&](const auto& path) { hold(corner, *arc, path, cuts, before); },
        shortened(*arc, {before.tool_start, joint.end, left}, Consumed::runs_back, tolerances_));
  } else {
    const Line path{.start = before.tool_start, .end = joint.end};
    hold(corner, std::get<Line>(before.programmed->path), path, cuts, before);
  }
  if (!joint.inserted().empty()) hold_inserted(joint, gap, before, after);
}

template <class Programmed, class Path>
void ShortWay::hold(const Corner& corner, const Programmed& programmed, const Path& path,
                    const HeldPath::Cuts& cuts, const Step& before) {
  const double left_inside =
      before.extent - std::max(cuts.at_start, 0.0) - std::max(cuts.at_end, 0.0);
  Certificate::Block course{.tangent_at_start = before.tangent_at_start,
                            .tangent_at_end = corner.before.tangent,
                            .left = before.unreachable ? 0 : left_inside * before.radius,
                            .shift_at_start = shift_,
                            .shift_at_end = shift_};
  if constexpr (std::is_same_v<Programmed, Arc>) course.sweep = programmed.sweep;
  const LoopRemoval::PlainBlock<Programmed, Path> plain{
      *before.programmed, programmed, path, cuts, course, before.unreachable};
  going_ = loop_removal_.take(plain, leaving_);
}

void ShortWay::hold_inserted(const Joint& joint, bool gap, const Step& before, const Step& after) {
  const MotionBlock& programmed = *before.programmed;
  const bool has_more = programmed.rapid || programmed.feed <= 0 || programmed.normal.moves() ||
                        !programmed.tracking.empty();
  if (has_more) insert_behind(programmed, *after.programmed, inserted_);
  const bool rapid = inserted_.rapid;
  for (const auto& segment : joint.inserted()) {
    if (!going_) return;
    const auto take = [&](const auto& path) {
      if (!has_more) return loop_removal_.take_transition(path, gap, programmed.source, leaving_);
      inserted_.rapid = rapid && std::is_same_v<decltype(path), const Line&>;
      return loop_removal_.take_transition(path, gap, inserted_, leaving_);
    };
    going_ = std::visit(take, *segment);
  }
}

// What is reported belongs to the block that was taken last: the run ends with it.
void ShortWay::put_out_leaving(std::vector<CompensatedBlock>& out) {
  if (going_ && !leaving_.empty()) going_ = leave_selection_(leaving_, out);
  leaving_.clear();
  // What is told of a line follows that line.
  going_ = going_ && diagnostics_.pending().empty();
}

}  // namespace trc
