#include "core/trc/passes/inside_corner.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/geometry/distance.h"
#include "core/trc/corner/corner.h"
#include "core/trc/result/selection_limit.h"

namespace trc {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Corner closing_corner(const PathBlock& last, const PathBlock& first, const Tolerances& tolerances) {
  Corner corner{.programmed = start_of(first.programmed.path)};
  corner.shift = first.at_start.shift;
  corner.before =
      offset_curve(last.programmed.path, last.tangent_at_end, last.offset_end, corner.shift);
  corner.after =
      offset_curve(first.programmed.path, first.tangent_at_start, first.offset_start, corner.shift);
  corner.reversal = reversal_of(corner, last.programmed.path, first.programmed.path, tolerances);
  return corner;
}

// Where path and contour begin and end; empty if their equidistants do not meet.
std::optional<Joint> closing_joint(const PathBlock& last, const PathBlock& first,
                                   const Tolerances& tolerances) {
  const Corner corner = closing_corner(last, first, tolerances);
  switch (kind_of(corner, tolerances)) {
    case CornerKind::tangential:
      return tangential_joint(corner);
    case CornerKind::inside:
      if (const auto inside = inside_joint(corner, tolerances)) return Joint(*inside);
      return std::nullopt;
    case CornerKind::outside:
      break;
  }
  Joint joint;
  joint.end = corner.before.anchor;
  joint.start = corner.after.anchor;
  return joint;
}

bool is_full_circle(const Segment& segment, double same_point) {
  return is_arc(segment) && (start_of(segment) - end_of(segment)).norm() <= same_point;
}

}  // namespace

bool InsideCorner::feed(PathBlockPtr block, PathBlocks& out) {
  if (ignores(*block)) {
    out.push_back(std::move(block));
    return true;
  }
  if (begins(*block) || block->role == Role::contour) {
    if (held_.size() >= selection_blocks_)
      return diagnostics_.report(selection_too_long(block->programmed.source, selection_blocks_));
    held_.push_back(std::move(block));
    return true;
  }
  if (!close(block->role == Role::retract ? block.get() : nullptr, out)) return false;
  out.push_back(std::move(block));
  return true;
}

bool InsideCorner::drain(PathBlocks& out) { return held_.empty() || close(nullptr, out); }

bool InsideCorner::close(PathBlock* retract, PathBlocks& out) {
  PathBlock& approach = *held_.front();
  // The program has ended after the approach.
  if (held_.size() == 1) return refuse(Code::contour_not_closed, approach);
  PathBlock& first = *held_[1];
  PathBlock& last = *held_.back();
  if (is_arc(approach.programmed.path)) return refuse(Code::circular_selection_block, approach);
  if (!check_contour(approach, first, last) || !check_start(approach) ||
      !give_points(approach, first, last, retract))
    return false;
  for (PathBlockPtr& block : held_) out.push_back(std::move(block));
  held_.clear();
  return true;
}

bool InsideCorner::check_contour(const PathBlock& approach, const PathBlock& first,
                                 const PathBlock& last) {
  const double gap = (end_of(last.programmed.path) - start_of(first.programmed.path)).norm();
  if (gap > tolerances_.same_point) return refuse(Code::contour_not_closed, last, {{"gap", gap}});
  if (is_full_circle(last.programmed.path, tolerances_.same_point))
    return refuse(Code::last_block_full_circle, last);
  const Corner corner = closing_corner(last, first, tolerances_);
  if (kind_of(corner, tolerances_) != CornerKind::outside) return true;
  Corner start = corner;
  start.before.tangent = approach.tangent_at_end;
  start.before.anchor = approach.offset_end;
  start.reversal = reversal_of(start, approach.programmed.path, first.programmed.path, tolerances_);
  if (kind_of(start, tolerances_) != CornerKind::outside) return true;
  return refuse(
      Code::inside_corner_angle_too_large, approach,
      {{"angle", transition_angle(start, tolerances_) * degrees}, {"largest_angle", 180}});
}

// Names the selection block by its number, as controls do, or by its line if it has none.
std::vector<DiagnosticValue> InsideCorner::named(const Source& selection_block) {
  if (selection_block.number != Source::no_number)
    return {{"selection_block", static_cast<double>(selection_block.number)}};
  std::vector<DiagnosticValue> values;
  append_place(values, "selection", selection_block);
  return values;
}

// Whether the tool is clear of the contour at its start, and comes in between the
// last and the first block only.
bool InsideCorner::check_start(const PathBlock& approach) {
  const Point& start = start_of(approach.programmed.path);
  const Line way{.start = start, .end = end_of(approach.programmed.path)};
  const double radius = std::abs(approach.at_end.shift);
  for (std::size_t i = 1; i < held_.size(); ++i) {
    checkpoint_.pass();
    const PathBlock& block = *held_[i];
    const double clearance = distance(start, block.programmed.path);
    if (clearance < radius - tolerances_.on_contour) {
      std::vector<DiagnosticValue> values = named(approach.programmed.source);
      values.push_back({"distance", block.mode().cutting_radius(clearance)});
      values.push_back({"tool_radius", block.mode().cutting_radius(radius)});
      return refuse(Code::selection_point_too_near, block, std::move(values));
    }
    const bool neighbour = i == 1 || i + 1 == held_.size();
    if (!neighbour && meet(way, block.programmed.path, tolerances_.same_point))
      return refuse(Code::approach_crosses_contour, block);
  }
  return true;
}

bool InsideCorner::give_points(PathBlock& approach, const PathBlock& first, PathBlock& last,
                               PathBlock* retract) {
  const auto joint = closing_joint(last, first, tolerances_);
  if (!joint) return refuse(Code::line_reversed, last);
  approach.offset_end = joint->start;
  approach.cut_at_end = joint->cut_after;
  last.offset_end = joint->end;
  last.cut_at_end = joint->cut_before;
  if (retract != nullptr) {
    retract->offset_start = joint->end;
    retract->cut_at_start = joint->cut_before;
  }
  return true;
}

void InsideCorner::keep_refused_way() {
  const PathBlock& first = *held_[1];
  const PathBlock& last = *held_.back();
  // A circular approach is refused before the contour is checked.
  const double gap = (end_of(last.programmed.path) - start_of(first.programmed.path)).norm();
  if (gap > tolerances_.same_point || is_full_circle(last.programmed.path, tolerances_.same_point))
    return;
  const auto joint = closing_joint(last, first, tolerances_);
  if (!joint) return;
  const CornerKind kind = kind_of(closing_corner(last, first, tolerances_), tolerances_);
  refused_way_ = {.shift = held_.front()->at_end.shift,
                  .kind = WayIntoCorner{.target = joint->start,
                                        .starts_on_tool_side = kind == CornerKind::outside}};
  refused_way_->blocks.reserve(held_.size());
  for (const PathBlockPtr& block : held_) refused_way_->blocks.push_back(block->programmed);
}

bool InsideCorner::refuse(Code code, const PathBlock& block, std::vector<DiagnosticValue> values) {
  Diagnostic problem = diagnostic(code, block.programmed.source);
  problem.values = std::move(values);
  const bool is_of_start =
      code == Code::selection_point_too_near || code == Code::approach_crosses_contour ||
      code == Code::circular_selection_block || code == Code::inside_corner_angle_too_large;
  if (is_of_start) keep_refused_way();
  if (code == Code::selection_point_too_near) {
    const MotionBlock& approach = held_.front()->programmed;
    const Position start =
        from_plane(approach.mode->plane, start_of(approach.path), approach.normal.from);
    problem.point = DiagnosticPoint{.x = start[0], .y = start[1], .z = start[2]};
  }
  return diagnostics_.report(std::move(problem));
}

}  // namespace trc
