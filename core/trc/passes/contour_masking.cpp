#include "core/trc/passes/contour_masking.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/geometry/distance.h"
#include "core/geometry/parallel.h"
#include "core/trc/corner/joints.h"
#include "core/trc/selection/selection_limit.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// The radius of the equidistant, by which an angle becomes a length; 1 for lines.
double radius_at(const PathBlock& block, double shift) {
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  return arc != nullptr ? parallel_radius(*arc, shift) : 1;
}

double equidistant_length(const PathBlock& block) {
  return left_of_block(block, 0, 0) * radius_at(block, block.at_end.shift);
}

OffsetCurve end_curve(const PathBlock& block) {
  return offset_curve(block.programmed.path, block.tangent_at_end, block.offset_end,
                      block.at_end.shift);
}

OffsetCurve start_curve(const PathBlock& block) {
  return offset_curve(block.programmed.path, block.tangent_at_start, block.offset_start,
                      block.at_start.shift);
}

// Both equidistants lie on one line or on one circle and are travelled the same way: walls beside a
// notch. The first one then goes on to where the second one begins. How far on a circle, rad,
// cannot be told from how far back: whichever is nearer.
std::optional<PathBlock::Rejoin> join_in_line(const OffsetCurve& before, const OffsetCurve& after,
                                              double same_point) {
  const Point& point = after.anchor;
  if (before.circular != after.circular) return std::nullopt;
  if (!before.circular) {
    const double aside = std::max(std::abs(cross(before.tangent, point - before.anchor)),
                                  std::abs(cross(after.tangent, point - before.anchor)));
    if (aside > same_point || before.tangent.dot(after.tangent) <= 0) return std::nullopt;
    return PathBlock::Rejoin{.point = point, .cut_before = cut_before_anchor(before, point, 0)};
  }
  const bool one_circle = before.counter_clockwise == after.counter_clockwise &&
                          (before.circle.center - after.circle.center).norm() <= same_point &&
                          std::abs(before.circle.radius - after.circle.radius) <= same_point;
  if (!one_circle) return std::nullopt;
  const double back = cut_before_anchor(before, point, same_point);
  return PathBlock::Rejoin{
      .point = point, .cut_before = back > std::numbers::pi ? back - 2 * std::numbers::pi : back};
}

}  // namespace

bool ContourMasking::feed(PathBlockPtr block, PathBlocks& out) {
  const bool masking = masks(*block);
  const bool continues = !held_.empty() && is_contour(*block) && !block->perpendicular_entry;
  if (continues && masking) {
    if (held_.size() >= selection_blocks_)
      return diagnostics_.report(selection_too_long(block->programmed.source, selection_blocks_));
    held_.push_back(std::move(block));
    if (window_ == 0) return true;
    if (!keep(base_ + held_.size() - 1)) return false;
    return held_.size() <= window_ || let_go(out);
  }
  if (!resolve(block->at_start.active ? block.get() : nullptr, out)) return false;
  if (masking && block->at_end.active) {
    // The first block has a start of its own: an approach, or what came before G141.
    held_.push_back(std::move(block));
    kept_ = {Kept{.index = 0}};
  } else {
    out.push_back(std::move(block));
  }
  return true;
}

bool ContourMasking::resolve(const PathBlock* after, PathBlocks& out) {
  if (held_.empty()) return true;
  if (window_ == 0) {
    for (std::size_t index = 1; index < held_.size(); ++index) {
      checkpoint_.pass();
      if (!keep(index)) return false;
    }
  }
  if (!close(after)) return false;
  report_masked(base_, base_ + held_.size());
  for (PathBlockPtr& block : held_) out.push_back(std::move(block));
  held_.clear();
  base_ = 0;
  return true;
}

bool ContourMasking::let_go(PathBlocks& out) {
  // So many masked blocks that the window does not see the end of them.
  if (kept_.size() == 1) return refuse_to_mask(*held_.front());
  const std::size_t next = kept_[1].index;
  report_masked(base_, next);
  const auto gone = static_cast<std::ptrdiff_t>(next - base_);
  std::move(held_.begin(), held_.begin() + gone, std::back_inserter(out));
  held_.erase(held_.begin(), held_.begin() + gone);
  base_ = next;
  kept_.erase(kept_.begin());
  return true;
}

// Joins the block to the last kept one, masking kept blocks that do not survive it.
bool ContourMasking::keep(std::size_t index) {
  PathBlock& block = held(index);
  const bool begins_contour = kept_.size() == 1 && !is_contour(*held_.front());
  if (block.masked) return !begins_contour || refuse_to_mask(block);
  while (true) {
    const Kept& last = kept_.back();
    const PathBlock& before = held(last.index);
    const bool adjacent = last.index + 1 == index;
    const auto meeting = meet(last.index, index);
    if (meeting && survives(last, meeting->cut_before)) {
      block.rejoin = meeting->rejoin;
      kept_.push_back({.index = index, .cut_at_start = meeting->cut_after});
      return true;
    }
    // Of two that do not meet, or only where there is nothing of either, the one with less to cut
    // gives way.
    const bool apart = !meeting || (!adjacent && left_of_block(block, meeting->cut_after, 0) < 0);
    if (apart && !begins_contour && equidistant_length(block) < equidistant_length(before)) {
      block.masked = true;
      return true;
    }
    if (!mask_last_kept()) return false;
  }
}

// The last block must survive its end: nothing lies behind it to join anew.
bool ContourMasking::close(const PathBlock* after) {
  PathBlock& last = *held_.back();
  if (last.masked) return refuse_to_mask(last);
  double cut_at_end = 0;
  if (after != nullptr) {
    const Corner corner = corner_between(last, *after, tolerances_);
    const JointResult result = joint_between(last, *after, corner, tolerances_);
    const auto* joined = std::get_if<JoinedBlocks>(&result);
    // What cannot be joined is refused by Transitions, with its reason.
    if (joined != nullptr) cut_at_end = joined->joint.cut_before;
  }
  return survives(kept_.back(), cut_at_end) || refuse_to_mask(last);
}

std::optional<ContourMasking::Meeting> ContourMasking::meet(std::size_t before,
                                                            std::size_t after) const {
  if (before + 1 == after) {
    const Corner corner = corner_between(held(before), held(after), tolerances_);
    const JointResult result = joint_between(held(before), held(after), corner, tolerances_);
    if (const auto* joined = std::get_if<JoinedBlocks>(&result))
      return Meeting{.cut_before = joined->joint.cut_before, .cut_after = joined->joint.cut_after};
    return std::nullopt;
  }
  const auto rejoin = join_anew(before, after);
  if (!rejoin) return std::nullopt;
  return Meeting{
      .cut_before = rejoin->cut_before, .cut_after = rejoin->cut_after, .rejoin = rejoin};
}

// In line, or the nearest meeting of the two equidistants; at an outside corner of two lines
// the crossing of their extensions, as far as STRETCH_FACTOR lets them.
std::optional<PathBlock::Rejoin> ContourMasking::join_anew(std::size_t before_index,
                                                           std::size_t after_index) const {
  const PathBlock& before = held(before_index);
  const PathBlock& after = held(after_index);
  if (!is_contour(before)) return std::nullopt;
  const OffsetCurve curve_before = end_curve(before);
  const OffsetCurve curve_after = start_curve(after);
  auto in_line = join_in_line(curve_before, curve_after, tolerances_.same_point);
  if (in_line && are_passed(before_index, after_index, *in_line)) return in_line;
  if (const auto joint = nearest_meeting(curve_before, curve_after, tolerances_))
    return PathBlock::Rejoin{joint->point, joint->cut_before, joint->cut_after};
  if (curve_before.circular || curve_after.circular) return std::nullopt;
  const Meetings meetings =
      intersect(StraightLine{.point = curve_before.anchor, .direction = curve_before.tangent},
                StraightLine{.point = curve_after.anchor, .direction = curve_after.tangent});
  if (meetings.count == 0) return std::nullopt;
  const Point& point = meetings.points[0];
  const double limit =
      after.mode().options.stretch_factor * std::abs(after.at_start.shift) + tolerances_.same_point;
  const double cut_before = cut_before_anchor(curve_before, point, 0);
  const double cut_after = cut_after_anchor(curve_after, point, 0);
  if (cut_before < -limit || cut_after < -limit) return std::nullopt;
  return PathBlock::Rejoin{point, cut_before, cut_after};
}

// A notch lies behind the wall, a bump before it.
bool ContourMasking::are_passed(std::size_t before, std::size_t after,
                                const PathBlock::Rejoin& in_line) const {
  if (in_line.cut_before >= 0) return true;
  const OffsetCurve curve = end_curve(held(before));
  const double sweep = curve.counter_clockwise ? -in_line.cut_before : in_line.cut_before;
  const Segment path = curve.circular ? Segment(Arc{.start = curve.anchor,
                                                    .end = in_line.point,
                                                    .center = curve.circle.center,
                                                    .sweep = sweep})
                                      : Line{.start = curve.anchor, .end = in_line.point};
  const double radius = std::abs(held(after).at_start.shift);
  const double reach = radius - tolerances_.clearance * std::max(radius, 1.0);
  for (std::size_t index = before + 1; index < after; ++index) {
    const Segment& masked = held(index).programmed.path;
    if (nearness(path, masked, tolerances_.same_point).distance < reach) return false;
  }
  return true;
}

bool ContourMasking::survives(const Kept& kept, double cut_at_end) const {
  const PathBlock& block = held(kept.index);
  if (!is_contour(block)) return true;
  const double left = left_of_block(block, kept.cut_at_start, cut_at_end);
  return left * radius_at(block, block.at_end.shift) >= -tolerances_.on_contour;
}

bool ContourMasking::mask_last_kept() {
  PathBlock& block = held(kept_.back().index);
  const bool first_of_contour =
      kept_.size() == 1 || (kept_.size() == 2 && !is_contour(*held_.front()));
  if (first_of_contour) return refuse_to_mask(block);
  block.masked = true;
  block.rejoin.reset();
  kept_.pop_back();
  return true;
}

// One note for each run of masked blocks.
void ContourMasking::report_masked(std::size_t first, std::size_t end) {
  for (std::size_t index = first; index < end; ++index) {
    if (!held(index).masked) continue;
    const std::size_t begin = index;
    while (index + 1 < end && held(index + 1).masked) ++index;
    Diagnostic masked = diagnostic(Code::blocks_masked, held(begin).programmed.source);
    const auto number = [&](std::size_t at) {
      return static_cast<double>(held(at).programmed.source.index);
    };
    masked.values = {{"first_index", number(begin)},
                     {"last_index", number(index)},
                     {"tool_radius", std::abs(held(begin).at_end.shift)}};
    diagnostics_.report(std::move(masked));
  }
}

bool ContourMasking::refuse_to_mask(const PathBlock& block) {
  if (!is_arc(block.programmed.path)) return refuse(Code::line_reversed, block);
  const bool fits = radius_at(block, block.at_end.shift) >= tolerances_.on_contour;
  return refuse(fits ? Code::arc_wrapped : Code::tool_not_smaller_than_arc, block);
}

bool ContourMasking::refuse(Code code, const PathBlock& block) {
  Diagnostic problem = diagnostic(code, block.programmed.source);
  problem.values = {{"tool_radius", std::abs(block.at_end.shift)}};
  const Position place =
      from_plane(block.mode().plane, block.offset_end, block.programmed.normal.to);
  problem.point = DiagnosticPoint{.x = place[0], .y = place[1], .z = place[2]};
  return diagnostics_.report(std::move(problem));
}

}  // namespace trc
