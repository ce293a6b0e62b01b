#include "core/trc/passes/contour_masking.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/geometry/distance.h"
#include "core/geometry/parallel.h"
#include "core/trc/joints/joints.h"
#include "core/trc/joints/reach.h"
#include "core/trc/result/selection_limit.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// The radius of the equidistant, which turns an angle into a length; 1 for lines.
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

// Both equidistants lie on one line or on one circle and have the same direction: walls beside a
// notch. The first one then goes on to where the second one begins. On a circle, the way forwards
// and the way backwards (rad) cannot be told apart: the shorter one counts.
std::optional<PathBlock::Rejoin> join_in_line(const OffsetCurve& before, const OffsetCurve& after,
                                              double same_point) {
  const Point& point = after.anchor;
  if (before.circular != after.circular) return std::nullopt;
  if (!before.circular) {
    const double aside = std::max(std::abs(cross(before.tangent, point - before.anchor)),
                                  std::abs(cross(after.tangent, point - before.anchor)));
    if (aside > same_point || before.tangent.dot(after.tangent) <= 0) return std::nullopt;
    return PathBlock::Rejoin{
        .point = point, .start = point, .cut_before = cut_before_anchor(before, point, 0)};
  }
  const bool one_circle = before.counter_clockwise == after.counter_clockwise &&
                          (before.circle.center - after.circle.center).norm() <= same_point &&
                          std::abs(before.circle.radius - after.circle.radius) <= same_point;
  if (!one_circle) return std::nullopt;
  const double back = cut_before_anchor(before, point, same_point);
  return PathBlock::Rejoin{
      .point = point,
      .start = point,
      .cut_before = back > std::numbers::pi ? back - 2 * std::numbers::pi : back};
}

// How far the start of the second block may lie beside the way on which the first one goes on, and
// the end of the first one beside the way back: the effect of rounded ends grows with the distance
// of the blocks and falls with their lengths (D-44).
double most_aside(const PathBlock& before, const PathBlock& after, double resolution) {
  const double way = (after.offset_start - before.offset_end).norm();
  const double lengths =
      1 / length_of(before.programmed.path) + 1 / length_of(after.programmed.path);
  return resolution * (2 + way * lengths);
}

// Two lines are in line but for the rounding of their ends. The first one keeps its end, and a line
// leads over to where the second one begins.
std::optional<PathBlock::Rejoin> join_nearly_in_line(const PathBlock& before,
                                                     const PathBlock& after, double resolution) {
  if (is_arc(before.programmed.path) || is_arc(after.programmed.path)) return std::nullopt;
  const Vector way = after.offset_start - before.offset_end;
  if (way.dot(before.tangent_at_end) <= 0 || way.dot(after.tangent_at_start) <= 0)
    return std::nullopt;
  const double aside = std::max(std::abs(cross(before.tangent_at_end, way)),
                                std::abs(cross(after.tangent_at_start, way)));
  if (aside > most_aside(before, after, resolution)) return std::nullopt;
  return PathBlock::Rejoin{.point = before.offset_end, .start = after.offset_start};
}

// Two arcs of one circle, likewise: an arc leads over.
std::optional<PathBlock::Rejoin> join_nearly_on_circle(const PathBlock& before,
                                                       const PathBlock& after,
                                                       const Tolerances& tolerances) {
  const OffsetCurve first = end_curve(before);
  const OffsetCurve second = start_curve(after);
  if (!first.circular || !second.circular || !first.exists() || !second.exists() ||
      first.counter_clockwise != second.counter_clockwise)
    return std::nullopt;
  const auto beside = [](const Circle& circle, const Point& point) {
    return std::abs((point - circle.center).norm() - circle.radius);
  };
  const double aside =
      std::max(beside(first.circle, second.anchor), beside(second.circle, first.anchor));
  if (aside > most_aside(before, after, tolerances.input_resolution)) return std::nullopt;
  const Segment way = refitted(std::get<Arc>(before.programmed.path), first.anchor, second.anchor,
                               tolerances.same_point);
  const auto* arc = std::get_if<Arc>(&way);
  if (arc == nullptr || std::abs(arc->sweep) > std::numbers::pi) return std::nullopt;
  return PathBlock::Rejoin{.point = first.anchor, .start = second.anchor, .leads_on_arc = true};
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
    return held_.size() <= window_ || release(out);
  }
  if (!resolve(block->at_start.active ? block.get() : nullptr, out)) return false;
  if (masking && block->at_end.active) {
    // The first block has its own start: from an approach, or from a block before G141.
    held_.push_back(std::move(block));
    kept_ = {Kept{.index = 0}};
    if (held_.front()->masked) return refuse_to_mask(0, 0);
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
  find_walls();
  if (!check_left_out()) return false;
  report_masked(base_, base_ + held_.size());
  for (PathBlockPtr& block : held_) out.push_back(std::move(block));
  held_.clear();
  base_ = 0;
  walls_ = {};
  longest_left_out_ = {};
  contour_length_ = 0;
  return true;
}

bool ContourMasking::release(PathBlocks& out) {
  // The window does not see the end of the masked blocks.
  if (kept_.size() == 1) return refuse_to_mask(base_, base_ + held_.size() - 1);
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
  if (block.masked) return !begins_contour || refuse_to_mask(index, index);
  while (true) {
    checkpoint_.pass();
    const Kept& last = kept_.back();
    const PathBlock& before = held(last.index);
    const bool adjacent = last.index + 1 == index;
    const auto meeting = meet(last.index, index);
    if (meeting && survives(last, meeting->cut_before)) {
      block.rejoin = meeting->rejoin;
      kept_.push_back({.index = index, .cut_at_start = meeting->cut_after});
      return true;
    }
    // If two blocks do not meet, or only beyond the end of the second one, the shorter one is
    // masked.
    const bool gap = !meeting || (!adjacent && left_of_block(block, meeting->cut_after, 0) < 0);
    if (gap && !begins_contour && equidistant_length(block) < equidistant_length(before)) {
      block.masked = true;
      return true;
    }
    if (!mask_last_kept(index)) return false;
  }
}

// The last block must survive its end: no block after it could be joined anew.
bool ContourMasking::close(const PathBlock* after) {
  PathBlock& last = *held_.back();
  const std::size_t last_index = base_ + held_.size() - 1;
  if (last.masked) return refuse_to_mask(kept_.back().index, last_index);
  double cut_at_end = 0;
  if (after != nullptr) {
    const Corner corner = corner_between(last, *after, tolerances_);
    const JointResult result = joint_between(last, *after, corner, tolerances_);
    const auto* joined = std::get_if<JoinedBlocks>(&result);
    // Transitions refuses blocks that cannot be joined, with the reason.
    if (joined != nullptr) cut_at_end = joined->joint.cut_before;
  }
  return survives(kept_.back(), cut_at_end) || refuse_to_mask(last_index, last_index);
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
// the crossing of their extensions, as far as STRETCH_FACTOR allows (D-153).
std::optional<PathBlock::Rejoin> ContourMasking::join_anew(std::size_t before_index,
                                                           std::size_t after_index) const {
  const PathBlock& before = held(before_index);
  const PathBlock& after = held(after_index);
  if (!is_contour(before)) return std::nullopt;
  const OffsetCurve curve_before = end_curve(before);
  const OffsetCurve curve_after = start_curve(after);
  auto in_line = join_in_line(curve_before, curve_after, tolerances_.same_point);
  if (!in_line) in_line = join_nearly_in_line(before, after, tolerances_.input_resolution);
  if (!in_line) in_line = join_nearly_on_circle(before, after, tolerances_);
  if (in_line && are_passed(before_index, after_index, *in_line)) return in_line;
  if (const auto joint = nearest_meeting(curve_before, curve_after, tolerances_))
    return PathBlock::Rejoin{joint->point, joint->point, joint->cut_before, joint->cut_after};
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
  return PathBlock::Rejoin{point, point, cut_before, cut_after};
}

// A notch lies behind the wall, a bump before it.
bool ContourMasking::are_passed(std::size_t before, std::size_t after,
                                const PathBlock::Rejoin& in_line) const {
  if (in_line.cut_before >= 0 && in_line.start == in_line.point) return true;
  const OffsetCurve curve = end_curve(held(before));
  const Segment& programmed = held(before).programmed.path;
  const Segment path = curve.circular ? refitted(std::get<Arc>(programmed), curve.anchor,
                                                 in_line.start, tolerances_.same_point)
                                      : Line{.start = curve.anchor, .end = in_line.start};
  const double radius = std::abs(held(after).at_start.shift);
  const bool by_rounding = in_line.start != in_line.point;
  const double reach = radius - (by_rounding ? tolerances_.on_contour
                                             : tolerances_.clearance * std::max(radius, 1.0));
  for (std::size_t index = before + 1; index < after; ++index) {
    checkpoint_.pass();
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

bool ContourMasking::mask_last_kept(std::size_t joining) {
  PathBlock& block = held(kept_.back().index);
  const bool first_of_contour =
      kept_.size() == 1 || (kept_.size() == 2 && !is_contour(*held_.front()));
  if (first_of_contour) return refuse_to_mask(kept_.back().index, joining);
  block.masked = true;
  block.rejoin.reset();
  kept_.pop_back();
  return true;
}

// The block at fault is the one that needs the smallest tool (D-146); the first or last one, which
// could not be masked, is usually sound.
bool ContourMasking::refuse_to_mask(std::size_t first, std::size_t last) {
  std::size_t worst = last;
  std::optional<double> largest_radius;
  for (std::size_t index = std::max(first, base_ + 1); index <= last; ++index) {
    const bool has_neighbours = index + 1 < base_ + held_.size();
    if (!has_neighbours || !is_contour(held(index))) continue;
    checkpoint_.pass();
    const PathBlock& before = held(index - 1);
    const PathBlock& after = held(index + 1);
    const double most = largest_radius.value_or(std::abs(held(index).at_end.shift));
    if (is_reached(before, held(index), after, most, tolerances_)) continue;
    largest_radius = largest_radius_for(before, held(index), after, tolerances_);
    worst = index;
  }
  const PathBlock& block = held(worst);
  if (!is_arc(block.programmed.path)) return refuse(Code::line_reversed, block, largest_radius);
  const bool fits = radius_at(block, block.at_end.shift) >= tolerances_.on_contour;
  return refuse(fits ? Code::arc_wrapped : Code::tool_not_smaller_than_arc, block, largest_radius);
}

bool ContourMasking::refuse(Code code, const PathBlock& block,
                            std::optional<double> largest_radius) {
  Diagnostic problem = diagnostic(
      code, block.programmed.source,
      "G141 finds no way past this block; #TRC [REMOVE_MASKED_BLOCKS=1] leaves out whole loops");
  const TrcMode& mode = block.mode();
  problem.values = {{"tool_radius", mode.cutting_radius(std::abs(block.at_end.shift))}};
  if (largest_radius && !mode.below_nominal)
    problem.values.push_back({"largest_radius", mode.cutting_radius(*largest_radius)});
  const Position place =
      from_plane(block.mode().plane, block.offset_end, block.programmed.normal.to);
  problem.point = DiagnosticPoint{.x = place[0], .y = place[1], .z = place[2]};
  return diagnostics_.report(std::move(problem));
}

}  // namespace trc
