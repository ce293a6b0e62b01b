#include "core/trc/contour_run.h"

#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "core/geometry/parallel.h"
#include "core/trc/contour_violations.h"
#include "core/trc/tool_path.h"

namespace trc {
namespace {

bool is_plain(const TrcMode& mode) {
  const TrcOptions& options = mode.options;
  return mode.masking == Masking::off && mode.feed_adaptation == FeedAdaptation::off &&
         !options.kerf_masking && !options.ignore_cont_damage &&
         !options.ext_angle_block_intersection && !options.gen_cir_block_in_corner &&
         !options.inverse;
}

// In the middle of a contour, under one compensation, and nothing else.
bool is_plain(const PathBlock& block) {
  return block.role == Role::contour && block.origin == Origin::programmed &&
         block.at_start == block.at_end && !block.perpendicular_entry &&
         !block.perpendicular_exit && !block.path_given && !block.masked && !block.rejoin &&
         !block.unreachable && block.riders.empty() && block.riders_after_exit.empty();
}

}  // namespace

bool ContourRun::may_begin(const PathBlock& open, const PathBlock& held) const {
  return !inverse_path_ && is_plain(open) && is_plain(held) && open.at_end == held.at_end &&
         open.programmed.mode == held.programmed.mode && is_plain(held.mode());
}

std::size_t ContourRun::take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                             std::vector<CompensatedBlock>& out) {
  mode_ = held.programmed.mode.get();
  shift_ = held.at_end.shift;
  Step step = offset(open.programmed);
  step.tool_start = open.tool_start;
  step.cut_at_start = open.cut_at_start;
  MotionBlock* last = &held.programmed;
  std::size_t count = 0;
  for (Block& block : blocks) {
    auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || motion->mode.get() != mode_) break;
    Step next = offset(*last);
    if (!exists(next) || !join(step, next, out)) break;
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
  return step;
}

// Else 90017.
bool ContourRun::exists(const Step& step) const {
  return !step.at_start.circular || step.at_start.circle.radius >= tolerances_.on_contour;
}

bool ContourRun::join(Step& before, Step& after, std::vector<CompensatedBlock>& out) {
  const Corner corner{.programmed = end_of(before.programmed->path),
                      .before = before.at_end,
                      .after = after.at_start,
                      .shift = shift_};
  const std::optional<Joint> joint = joint_of(corner);
  if (!joint) return false;
  const std::optional<Segment> path = tool_path(before, *joint);
  if (!path) return false;
  for (const auto& inserted : joint->inserted())
    if (out_of_range(*inserted, tolerances_)) return false;

  after.tool_start = joint->start;
  after.cut_at_start = joint->cut_after;
  MotionBlock& programmed = *before.programmed;
  reporting_.summary().programmed_length += length_of(programmed.path);
  if (joint->inserted().empty()) {
    reporting_.put_out(programmed, *mode_, Origin::programmed, *path, out);
  } else {
    put_out_with(joint->inserted(), *path, programmed, *after.programmed, out);
  }
  return true;
}

void ContourRun::put_out_with(std::span<const std::optional<Segment>> inserted, const Segment& path,
                              MotionBlock& programmed, const MotionBlock& after,
                              std::vector<CompensatedBlock>& out) {
  // Before its tracking axes go with the block.
  MotionBlock insertion = insertion_behind(programmed, after);
  reporting_.put_out(programmed, *mode_, Origin::programmed, path, out);
  for (const auto& segment : inserted) {
    const TrackingTravel tracking = insertion.tracking;
    reporting_.put_out(insertion, *mode_, Origin::transition, *segment, out);
    insertion.tracking = tracking;
  }
}

// The rules between contour blocks (spec 4.2) as joint_between() has them for such blocks.
std::optional<Joint> ContourRun::joint_of(const Corner& corner) const {
  // Which kind of corner that is takes more than the corner.
  if (is_reversal(corner, tolerances_)) return std::nullopt;
  switch (kind_of(corner, tolerances_)) {
    case CornerKind::tangential:
      return tangential_joint(corner);
    case CornerKind::outside:
      return outside_joint(
          corner,
          {.transition = mode_->transition, .stretch_factor = mode_->options.stretch_factor},
          tolerances_);
    case CornerKind::inside:
      break;
  }
  const std::optional<MeetingPoint> meeting = inside_joint(corner, tolerances_);
  if (!meeting) return std::nullopt;
  return Joint(*meeting);
}

// Nothing where it is a contour violation.
std::optional<Segment> ContourRun::tool_path(const Step& step, const Joint& joint) const {
  const auto* arc = std::get_if<Arc>(&step.programmed->path);
  std::optional<Segment> path;
  if (arc == nullptr) {
    if (runs_back(joint.end - step.tool_start, step.at_end.tangent, tolerances_)) return path;
    path = Line{.start = step.tool_start, .end = joint.end};
  } else {
    const double left = std::abs(arc->sweep) - step.cut_at_start - joint.cut_before;
    if (is_consumed(left, step.at_end.circle.radius, tolerances_)) return path;
    path = shortened(*arc, step.tool_start, joint.end, left, false, tolerances_);
  }
  if (out_of_range(*path, tolerances_)) path.reset();
  return path;
}

}  // namespace trc
