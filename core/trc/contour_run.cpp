#include "core/trc/contour_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "core/geometry/parallel.h"
#include "core/trc/contour_violations.h"
#include "core/trc/joints.h"
#include "core/trc/tool_path.h"

namespace trc {
namespace {

bool is_plain(const TrcMode& mode, bool removes_loops) {
  const TrcOptions& options = mode.options;
  if (options.kerf_masking || options.conv_cir_to_lin || options.ext_angle_block_intersection ||
      options.gen_cir_block_in_corner || options.inverse)
    return false;
  return removes_loops ||
         (mode.masking == Masking::off && mode.feed_adaptation == FeedAdaptation::off &&
          !options.ignore_cont_damage);
}

// In the middle of a contour, under one compensation, and nothing else.
bool is_plain(const PathBlock& block) {
  return block.role == Role::contour && block.origin == Origin::programmed &&
         block.at_start == block.at_end && !block.perpendicular_entry &&
         !block.perpendicular_exit && !block.path_given && !block.masked && !block.rejoin &&
         !block.unreachable && block.riders.empty() && block.riders_after_exit.empty();
}

// A place for blocks of a run to be held from.
void make_ready(PathBlock& place, Role role, Origin origin, const PathBlock& held) {
  place.role = role;
  place.origin = origin;
  place.at_start = place.at_end = held.at_end;
  if (place.programmed.mode != held.programmed.mode) place.programmed.mode = held.programmed.mode;
}

}  // namespace

bool ContourRun::may_begin(const PathBlock& open, const PathBlock& held) const {
  const bool removes_loops = loop_removal_.takes_contour();
  return (removes_loops || !inverse_path_) && held.removes_loops() == removes_loops &&
         is_plain(open) && is_plain(held) && open.at_end == held.at_end &&
         open.programmed.mode == held.programmed.mode && is_plain(held.mode(), removes_loops);
}

std::size_t ContourRun::take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                             std::vector<CompensatedBlock>& out) {
  mode_ = held.programmed.mode.get();
  shift_ = held.at_end.shift;
  going_ = true;
  removes_loops_ = held.removes_loops();
  if (removes_loops_) {
    make_ready(contour_block_, Role::contour, Origin::programmed, held);
    make_ready(inserted_, Role::inserted, Origin::transition, held);
  }
  Step step = offset(open.programmed);
  step.tool_start = open.tool_start;
  step.cut_at_start = open.cut_at_start;
  MotionBlock* last = &held.programmed;
  std::size_t count = 0;
  for (Block& block : blocks) {
    auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || motion->mode.get() != mode_ || !going_) break;
    Step next = offset(*last);
    if (vanishes(next) || !join(step, next, out)) break;
    step = next;
    last = motion;
    ++count;
  }
  if (count == 0) return 0;
  open.programmed = std::move(*step.programmed);
  open.tangent_at_start = step.at_start.tangent;
  open.tangent_at_end = step.at_end.tangent;
  open.offset_start = step.at_start.anchor;
  open.offset_end = step.at_end.anchor;
  open.tool_start = step.tool_start;
  open.cut_at_start = step.cut_at_start;
  open.unreachable = step.unreachable;
  held.programmed = std::move(*last);
  return count;
}

ContourRun::Step ContourRun::offset(MotionBlock& programmed) const {
  const Segment& path = programmed.path;
  Step step{.programmed = &programmed};
  const Vector tangent = tangent_at_start(path);
  step.at_start =
      offset_curve(path, tangent, parallel_point(start_of(path), tangent, shift_), shift_);
  step.at_end = step.at_start;
  if (step.at_end.circular) step.at_end.tangent = tangent_at_end(path);
  step.at_end.anchor = parallel_point(end_of(path), step.at_end.tangent, shift_);
  step.unreachable = removes_loops_ && is_unreachable(step);
  return step;
}

bool ContourRun::is_unreachable(const Step& step) const {
  return step.at_start.circular &&
         step.at_start.circle.radius <= tolerances_.rounding * std::max(std::abs(shift_), 1.0);
}

// 90017, where no loops are removed.
bool ContourRun::vanishes(const Step& step) const {
  return !removes_loops_ && step.at_start.circular &&
         step.at_start.circle.radius < tolerances_.on_contour;
}

bool ContourRun::join(Step& before, Step& after, std::vector<CompensatedBlock>& out) {
  const std::optional<Joined> result = joined(before, after);
  if (!result) return false;
  const Joint& joint = result->joint;
  const std::optional<Segment> path = tool_path(before, joint);
  if (!path) return false;
  after.tool_start = joint.start;
  after.cut_at_start = joint.cut_after;
  if (removes_loops_) {
    hold(before, after, *result, *path);
    return true;
  }
  for (const auto& inserted : joint.inserted())
    if (out_of_range(*inserted, tolerances_)) return false;
  put_out(before, after, *result, *path, out);
  return true;
}

// The rules between contour blocks (spec 4.2) as joint_between() has them for such blocks.
std::optional<ContourRun::Joined> ContourRun::joined(const Step& before, const Step& after) const {
  const Corner corner{.programmed = end_of(before.programmed->path),
                      .before = before.at_end,
                      .after = after.at_start,
                      .shift = shift_};
  // Which kind of corner that is takes more than the corner.
  if (is_reversal(corner, tolerances_)) return std::nullopt;
  switch (kind_of(corner, tolerances_)) {
    case CornerKind::tangential:
      return Joined{.joint = tangential_joint(corner)};
    case CornerKind::outside:
      return Joined{.joint = outside_joint(corner,
                                           {.transition = mode_->transition,
                                            .stretch_factor = mode_->options.stretch_factor},
                                           tolerances_)};
    case CornerKind::inside:
      break;
  }
  return joined_inside(before, after, corner);
}

std::optional<ContourRun::Joined> ContourRun::joined_inside(const Step& before, const Step& after,
                                                            const Corner& corner) const {
  if (!removes_loops_) {
    if (const auto meeting = inside_joint(corner, tolerances_))
      return Joined{.joint = Joint(*meeting)};
    return std::nullopt;
  }
  const bool vanished = before.unreachable || after.unreachable;
  const auto meeting = vanished ? std::nullopt : inside_joint_to_all_digits(corner, tolerances_);
  if (meeting && extent_of(before.programmed->path) >= meeting->cut_before &&
      extent_of(after.programmed->path) >= meeting->cut_after)
    return Joined{.joint = Joint(*meeting)};
  return Joined{.joint = joint_across(corner.before.anchor, corner.after.anchor), .apart = true};
}

// Nothing where it is a contour violation.
std::optional<Segment> ContourRun::tool_path(const Step& step, const Joint& joint) const {
  const auto* arc = std::get_if<Arc>(&step.programmed->path);
  std::optional<Segment> path;
  if (arc == nullptr) {
    if (!removes_loops_ && runs_back(joint.end - step.tool_start, step.at_end.tangent, tolerances_))
      return path;
    path = Line{.start = step.tool_start, .end = joint.end};
  } else {
    const double left = std::abs(arc->sweep) - step.cut_at_start - joint.cut_before;
    if (!removes_loops_ && is_consumed(left, step.at_end.circle.radius, tolerances_)) return path;
    path = shortened(*arc, step.tool_start, joint.end, left, removes_loops_, tolerances_);
  }
  if (!removes_loops_ && out_of_range(*path, tolerances_)) path.reset();
  return path;
}

void ContourRun::put_out(const Step& before, const Step& after, const Joined& joined,
                         const Segment& path, std::vector<CompensatedBlock>& out) {
  MotionBlock& programmed = *before.programmed;
  reporting_.summary().programmed_length += length_of(programmed.path);
  if (const auto inserted = joined.joint.inserted(); inserted.empty()) {
    reporting_.put_out(programmed, *mode_, Origin::programmed, path, out);
  } else {
    put_out_with(inserted, path, programmed, *after.programmed, out);
  }
}

void ContourRun::put_out_with(std::span<const std::optional<Segment>> inserted, const Segment& path,
                              MotionBlock& programmed, const MotionBlock& after,
                              std::vector<CompensatedBlock>& out) {
  // Before its tracking axes go with the block.
  MotionBlock insertion;
  insert_behind(programmed, after, insertion);
  reporting_.put_out(programmed, *mode_, Origin::programmed, path, out);
  for (const auto& segment : inserted) {
    const TrackingTravel tracking = insertion.tracking;
    reporting_.put_out(insertion, *mode_, Origin::transition, *segment, out);
    insertion.tracking = tracking;
  }
}

void ContourRun::hold(const Step& before, const Step& after, const Joined& joined,
                      const Segment& path) {
  MotionBlock& programmed = *before.programmed;
  const auto inserted = joined.joint.inserted();
  if (!inserted.empty()) insert_behind(programmed, *after.programmed, inserted_.programmed);
  contour_block_.tangent_at_start = before.at_start.tangent;
  contour_block_.tangent_at_end = before.at_end.tangent;
  contour_block_.cut_at_start = before.cut_at_start;
  contour_block_.cut_at_end = joined.joint.cut_before;
  contour_block_.unreachable = before.unreachable;
  contour_block_.tool_path = path;
  // All but the mode, of which one share does for the run.
  MotionBlock& motion = contour_block_.programmed;
  motion.source = programmed.source;
  motion.path = programmed.path;
  motion.normal = programmed.normal;
  motion.feed = programmed.feed;
  motion.rapid = programmed.rapid;
  motion.tracking = std::move(programmed.tracking);
  going_ = loop_removal_.hold(contour_block_);
  inserted_.unreachable = joined.apart;
  const bool rapid = inserted_.programmed.rapid;
  for (const auto& segment : inserted) {
    inserted_.programmed.rapid = rapid && !is_arc(*segment);
    inserted_.tool_path = *segment;
    going_ = going_ && loop_removal_.hold(inserted_);
  }
}

}  // namespace trc
