#include "core/trc/passes/transitions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/parallel.h"
#include "core/trc/corner/bow_tie.h"
#include "core/trc/corner/radius_change.h"
#include "core/trc/corner/tool_path.h"
#include "core/trc/joints/joints.h"
#include "core/trc/joints/reach.h"
#include "core/trc/selection/on_path.h"

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// Builds the tool path between tool_start and `end`.
void complete(PathBlock& block, const Point& end, const Tolerances& tolerances) {
  if (block.path_given) return;
  if (block.role == Role::uncompensated) {
    block.tool_path = block.programmed.path;
    return;
  }
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  if (arc == nullptr) {
    block.tool_path = Line{.start = block.tool_start, .end = end};
  } else if (is_contour(block) && block.at_start != block.at_end) {
    block.tool_path = refitted(*arc, block.tool_start, end, tolerances.on_contour);  // D-20
  } else {
    const double left = left_of_block(block, block.cut_at_start, block.cut_at_end);
    const auto consumed = block.removes_loops() ? Consumed::runs_back : Consumed::wraps_round;
    block.tool_path = shortened(*arc, {block.tool_start, end, left}, consumed, tolerances);
  }
}

void open(PathBlock& block, const Point& start, double cut, const Tolerances& tolerances) {
  block.tool_start = start;
  block.cut_at_start = cut;
  if (!block.at_end.active) complete(block, end_of(block.programmed.path), tolerances);
}

// Puts the other axes of `inserted` where the block and its passive blocks leave them.
void stand_behind(const PathBlock& block, MotionBlock& inserted) {
  const PassiveBlock* last = block.passive.empty() ? nullptr : &block.passive.back();
  inserted.normal = standing(last != nullptr ? last->normal.to : block.programmed.normal.to);
  inserted.tracking.clear();
  for (const AxisTravel& axis : last != nullptr ? last->tracking : block.programmed.tracking)
    inserted.tracking.push_back(standing(axis.to));
}

// A block to insert after `before` and its passive blocks.
PathBlockPtr insertion_behind(const PathBlock& before, const PathBlock& after) {
  auto inserted = std::make_unique_for_overwrite<PathBlock>();
  inserted->role = Role::inserted;
  inserted->at_start = inserted->at_end = before.at_end;
  insert_behind(before.programmed, after.programmed, inserted->programmed);
  inserted->programmed.mode = before.programmed.mode;
  if (!before.passive.empty()) stand_behind(before, inserted->programmed);
  return inserted;
}

void insert(const Segment& segment, Origin origin, PathBlockPtr inserted, PathBlocks& out) {
  inserted->origin = origin;
  inserted->tool_path = segment;
  if (is_arc(segment)) inserted->programmed.rapid = false;
  out.push_back(std::move(inserted));
}

// Rule 7.2: lines only, below 180 degrees, G236 up to 90 degrees.
bool may_split(const Corner& corner, const PathBlock& block, Selection selection,
               const Tolerances& tolerances) {
  const TrcMode& mode = block.mode();
  if (mode.options.split.where == SplitOption::Where::off || mode.becomes_arc() ||
      is_arc(block.programmed.path))
    return false;
  const double angle = transition_angle(corner, tolerances);
  switch (selection) {
    case Selection::direct:
    case Selection::indirect:
    case Selection::without_block:
      return angle < pi - tolerances.tangent;
    case Selection::on_path:
      return angle <= pi / 2 + tolerances.tangent;
    case Selection::perpendicular:
    case Selection::inside_corner:
      break;
  }
  return false;
}

Origin origin_of_insertions(const PathBlock& before, const PathBlock& after) {
  if (!is_contour(before)) return Origin::approach;
  return is_contour(after) ? Origin::transition : Origin::retract;
}

}  // namespace

bool Transitions::feed(PathBlockPtr&& block, PathBlocks& out) {
  if (short_ && !take_short(block.get(), out)) return false;
  if (may_be_tied(*block)) {
    short_ = std::move(block);
    return true;
  }
  return take(std::move(block), out);
}

bool Transitions::may_be_tied(const PathBlock& block) const {
  if (!block.removes_loops() || !held_ || !is_contour(*held_) || !is_contour(block) ||
      block.masked || block.rejoin || !continues(block) || !masked_.empty() ||
      held_->at_end != block.at_start || block.at_start != block.at_end)
    return false;
  if (length_of(block.programmed.path) > longest_in_bow_tie(largest_bow_tie_for(block)))
    return false;
  // The short way leaves such blocks to this pass. Without an inside corner there is no bow tie.
  const Corner corner = corner_between(*held_, block, tolerances_);
  return corner.sine_of_turn() * corner.shift > 0 &&
         kind_of(corner, tolerances_) != CornerKind::tangential;
}

bool Transitions::take_short(PathBlock* after, PathBlocks& out) {
  PathBlockPtr between = std::exchange(short_, nullptr);
  const bool goes_on = after != nullptr && is_contour(*after) && !after->masked && !after->rejoin &&
                       continues(*after) && after->at_start == between->at_end;
  if (goes_on) {
    const auto tie = bow_tie_of(held_->programmed.path, between->programmed.path,
                                after->programmed.path, largest_bow_tie_for(*between), tolerances_);
    if (tie && tie->turns_left == (between->at_start.shift > 0))
      (tie->tip_at_end ? *after : *between).behind_tip = true;
  }
  return take(std::move(between), out);
}

bool Transitions::take(PathBlockPtr&& block, PathBlocks& out) {
  if (block->role == Role::passive) {
    out.push_back(std::move(block));
    return true;
  }
  if (block->masked) {
    masked_.push_back(std::move(block));
    return true;
  }
  std::optional<Segment> wall;
  if (held_ && continues(*block)) {
    if (is_contour(*held_) && is_contour(*block) && !block->rejoin) wall = held_->programmed.path;
    if (!join(*block, out)) return false;
  } else {
    if (held_) leave(&start_of(block->programmed.path), out);
    enter(*block, out);
  }
  wall_before_ = wall;
  if (block->at_end.active) {
    held_ = std::move(block);
  } else {
    out.push_back(std::move(block));
  }
  return true;
}

bool Transitions::drain(PathBlocks& out) {
  if (short_ && !take_short(nullptr, out)) return false;
  if (held_) leave(nullptr, out);
  return true;
}

void Transitions::enter(PathBlock& block, PathBlocks& out) const {
  const Point& start = start_of(block.programmed.path);
  if (!block.perpendicular_entry) {
    open(block, start, 0, tolerances_);
    return;
  }
  open(block, block.offset_start, 0, tolerances_);
  PathBlockPtr across = insertion_behind(block, block);
  // The axes are where they were before the block, whatever its passive blocks do after it.
  MotionBlock& motion = across->programmed;
  motion.normal = standing(block.programmed.normal.from);
  motion.tracking = block.programmed.tracking;
  for (AxisTravel& axis : motion.tracking) axis = standing(axis.from);
  insert(Line{.start = start, .end = block.offset_start}, Origin::approach, std::move(across), out);
}

void Transitions::leave(const Point* next_start, PathBlocks& out) {
  PathBlock& block = *held_;
  const bool stays = next_start != nullptr && !block.perpendicular_exit &&
                     (*next_start - block.offset_end).norm() <= tolerances_.same_point;
  const Point end = stays ? *next_start : block.offset_end;
  complete(block, end, tolerances_);
  if (!block.perpendicular_exit) {
    put_out_held(out);
    return;
  }
  std::vector<PassiveBlock> passive = std::move(block.passive_after_exit);
  const Point target = end_of(block.programmed.path);
  put_out_held(out);
  insert(Line{.start = end, .end = target}, Origin::retract, insertion_behind(block, block), out);
  out.back()->passive = std::move(passive);
}

// The held block must be complete.
void Transitions::put_out_held(PathBlocks& out) {
  if (held_->at_start != held_->at_end)
    if (PathBlockPtr first = take_first_half(*held_, tolerances_)) out.push_back(std::move(first));
  out.push_back(std::move(held_));
}

void Transitions::join_anew(PathBlock& after, PathBlocks& out) {
  PathBlock& before = *held_;
  const PathBlock::Rejoin& rejoin = *after.rejoin;
  before.cut_at_end = rejoin.cut_before;
  complete(before, rejoin.point, tolerances_);
  PathBlockPtr across;
  Segment way = Line{.start = rejoin.point, .end = rejoin.start};
  if (rejoin.leads_on_arc)
    way = refitted(std::get<Arc>(before.programmed.path), rejoin.point, rejoin.start,
                   tolerances_.same_point);
  if (rejoin.start != rejoin.point) {
    across = insertion_behind(before, after);
    // Masked blocks move the other axes all the same.
    stand_behind(*masked_.back(), across->programmed);
  }
  put_out_held(out);
  for (PathBlockPtr& masked : masked_) {
    masked->origin = Origin::masked;
    masked->tool_path = Line{.start = rejoin.point, .end = rejoin.point};
    out.push_back(std::move(masked));
  }
  masked_.clear();
  if (across) insert(way, Origin::transition, std::move(across), out);
  open(after, rejoin.start, rejoin.cut_after, tolerances_);
}

bool Transitions::join(PathBlock& after, PathBlocks& out) {
  if (after.rejoin) {
    join_anew(after, out);
    return true;
  }
  PathBlock& before = *held_;
  const Corner corner = corner_between(before, after, tolerances_);
  JointResult result = joint_between(before, after, corner, tolerances_);
  if (const auto* refusal = std::get_if<JointRefusal>(&result))
    return refuse(*refusal, corner, after);
  auto& [joint, tangential_path, gap] = std::get<JoinedBlocks>(result);
  if (tangential_path) {
    PathBlock& block = before.role == Role::approach ? before : after;
    block.tool_path = *tangential_path;
    block.path_given = true;
  }
  before.splittable = before.role == Role::approach &&
                      may_split(corner, before, before.mode().selection, tolerances_);
  after.splittable = after.role == Role::retract &&
                     may_split(corner, after, after.mode().deselection, tolerances_);
  before.cut_at_end = joint.cut_before;
  complete(before, joint.end, tolerances_);
  if (left_of_block(before, before.cut_at_start, before.cut_at_end) < 0) measure_room(after);
  const Origin origin = origin_of_insertions(before, after);
  const bool leads_on =
      is_contour(before) || before.role == Role::approach || before.role == Role::side_change;
  const bool radius_changes = leads_on && is_contour(after) && after.at_start != after.at_end &&
                              after.mode().options.perpendicular_radius_change;
  if (before.mode().below_nominal && !tell_depth(before, after, joint)) return false;
  const Point contour_start = joint.start;
  if (radius_changes) change_radius_at_once(corner, after, joint);
  open(after, joint.start, joint.cut_after, tolerances_);
  put_out_held(out);
  const bool leads_through_contour = gap;
  const bool changes_side =
      is_contour(before) && is_contour(after) && before.at_end.shift * after.at_start.shift < 0;
  const auto insert_here = [&](const Segment& segment, Origin why) {
    PathBlockPtr inserted = insertion_behind(before, after);
    inserted->unreachable = leads_through_contour;
    if (changes_side) inserted->at_end = after.at_start;
    insert(segment, why, std::move(inserted), out);
  };
  for (const auto& segment : joint.inserted()) insert_here(*segment, origin);
  if (radius_changes)
    insert_here(Line{.start = contour_start, .end = joint.start}, Origin::radius_change);
  return true;
}

void Transitions::measure_room(const PathBlock& after) {
  PathBlock& block = *held_;
  if (!wall_before_ || !is_contour(block) || !is_contour(after) || block.removes_loops() ||
      block.mode().below_nominal || block.at_start != block.at_end ||
      after.at_start != after.at_end)
    return;
  const double half = slot_width(*wall_before_, after.programmed.path) / 2;
  if (half > 0 && half < std::abs(block.at_end.shift)) {
    block.half_slot = half;
    return;
  }
  PathBlock before;
  before.programmed.path = *wall_before_;
  before.programmed.mode = block.programmed.mode;
  before.role = Role::contour;
  before.at_start = before.at_end = block.at_start;
  block.largest_radius = largest_radius_for(before, block, after, tolerances_);
}

// In wear mode, a smaller tool turns about the corner of the centre path, where it could go deeper.
bool Transitions::tell_depth(const PathBlock& before, const PathBlock& after, const Joint& joint) {
  if (!is_contour(before) || !is_contour(after) || !after.mode().below_nominal ||
      joint.inserted().empty())
    return true;
  const Point& corner = start_of(after.programmed.path);
  const Vector across = left_of(tangent_at_end(before.programmed.path)) +
                        left_of(tangent_at_start(after.programmed.path));
  // Length of the sum of two unit vectors: below it the path reverses, and no corner could be cut
  // deeper.
  constexpr double reverses = 1e-2;
  if (across.norm() < reverses) return true;
  const double shift = std::abs(after.at_start.shift);
  const Vector outward = (after.at_start.shift < 0 ? -1 : 1) * across.normalized();
  double reached = 0;
  for (const auto& segment : joint.inserted()) {
    if (is_arc(*segment)) reached = shift;
    reached = std::max({reached, (start_of(*segment) - corner).dot(outward),
                        (end_of(*segment) - corner).dot(outward)});
  }
  const double deeper = 2 * shift / across.norm() - reached;
  constexpr double worth_telling = 1e-3;  // mm more than before
  if (deeper < deepest_told_ + worth_telling) return true;
  deepest_told_ = deeper;
  Diagnostic told = diagnostic(Code::wear_not_deeper, after.programmed.source);
  told.values = {{"deeper", deeper}, {"tool_radius", after.mode().cutting_radius()}};
  const Position place = from_plane(after.mode().plane, corner, after.programmed.normal.from);
  told.point = DiagnosticPoint{.x = place[0], .y = place[1], .z = place[2]};
  return diagnostics_.report(std::move(told));
}

// D-21: the corner is solved with the old radius on both sides; a line across the
// contour leads to the new equidistant.
void Transitions::change_radius_at_once(const Corner& corner, PathBlock& after,
                                        Joint& joint) const {
  const OffsetCurve& curve = corner.after;
  Vector along = curve.tangent;
  if (curve.circular) {
    const Vector radial = (joint.start - curve.circle.center).normalized();
    along = curve.counter_clockwise ? left_of(radial) : Vector(-left_of(radial));
  }
  joint.start = parallel_point(joint.start, along, after.at_end.shift - after.at_start.shift);
  after.at_start = after.at_end;
}

NeededLength Transitions::needed_length(const Corner& corner, const PathBlock& after) const {
  const bool leaves = after.role == Role::retract;
  const PathBlock& block = leaves ? after : *held_;
  // The arc of G05 needs another direction, not a length.
  if (block.mode().becomes_arc()) return {};
  const selection::AroundCorner around = selection::around_corner(block.mode());
  const auto needed = [&](const Segment& path, const Vector& tangent) {
    return leaves ? selection::needed_off_path(corner, path, tangent, around, tolerances_)
                  : selection::needed_on_path(corner, path, tangent, around, tolerances_);
  };
  const Vector& tangent = leaves ? block.tangent_at_start : block.tangent_at_end;
  return {.along_itself = needed(block.programmed.path, tangent),
          .straight = needed(Line{}, tangent)};
}

void Transitions::keep_refused_way(const Corner& corner, const PathBlock& after) {
  const PathBlock& before = *held_;
  const bool leaves = after.role == Role::retract;
  // A change of side has a contour at both ends (D-150).
  if (!leaves && before.role != Role::approach) return;
  const NeededLength needed = needed_length(corner, after);
  refused_way_ = {.blocks = {before.programmed, after.programmed},
                  .shift = corner.shift,
                  .kind = WayIn{.needed = needed}};
  if (leaves) refused_way_->kind = WayOut{.needed = needed, .cut_at_start = before.cut_at_start};
}

bool Transitions::refuse(const JointRefusal& refusal, const Corner& corner,
                         const PathBlock& after) {
  const PathBlock& block = refusal.of_after ? after : *held_;
  // KONT needs a place outside the circle about the corner, not a length.
  const Selection selection = refusal.of_after ? block.mode().deselection : block.mode().selection;
  const bool is_of_way =
      (refusal.code == Code::selection_block_too_short && selection != Selection::indirect) ||
      refusal.code == Code::tangential_start_on_tangent;
  if (is_of_way) keep_refused_way(corner, after);
  Diagnostic problem = diagnostic(refusal.code, block.programmed.source);
  const Position position =
      from_plane(block.mode().plane, refusal.place, block.programmed.normal.to);
  problem.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  problem.values = {{"tool_radius", block.mode().cutting_radius()}};
  return diagnostics_.report(std::move(problem));
}

}  // namespace trc
