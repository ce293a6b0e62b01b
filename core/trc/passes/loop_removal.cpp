#include "core/trc/passes/loop_removal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/trc/corner/bow_tie.h"
#include "core/trc/result/selection_limit.h"
#include "core/trc/walls/closing.h"

namespace trc {
namespace {

// The line that REVERSE puts between the two sides of a corner (D-22) is near to both by intent.
bool crosses_contour(const PathBlock& block) {
  return block.role == Role::inserted && block.at_start.shift * block.at_end.shift < 0;
}

// Approach and retract have their own rules (D-11).
bool is_compensated(const PathBlock& block) {
  return block.role == Role::contour ||
         (block.role == Role::inserted &&
          (block.origin == Origin::transition || block.origin == Origin::radius_change));
}

}  // namespace

static_assert(ReleasingPass<LoopRemoval, PathBlockPtr, PathBlockPtr>);

bool LoopRemoval::feed(PathBlockPtr block, PathBlocks& out) {
  if (phase_ == Phase::leaving) {
    behind_.blocks.push_back(std::move(block));
    return true;
  }
  const bool enters = block->role == Role::inserted && block->origin == Origin::approach;
  const bool belongs = block->removes_loops() && !crosses_contour(*block) &&
                       (block->role == Role::approach || enters || is_compensated(*block));
  // A change of side ends the contour, also on the spot (D-42).
  const bool changes_side =
      end_of_contour() > 0 && held_.path.mode_of(end_of_path() - 1).side != block->mode().side;
  const bool goes_on = is_compensated(*block) && !block->perpendicular_entry && !changes_side;
  if (phase_ == Phase::holding && (!belongs || (!goes_on && end_of_contour() > 0))) {
    behind_.blocks.push_back(std::move(block));
    return end_selection();
  }
  if (!belongs) {
    out.push_back(std::move(block));
    return true;
  }
  phase_ = Phase::holding;
  if (!is_compensated(*block)) {
    held_.entering.push_back(std::move(block));
    return true;
  }
  return hold(*block) && (window_ == 0 || proceed(out));
}

bool LoopRemoval::end() {
  if (phase_ != Phase::leaving) return end_selection();
  behind_.input = Input::ended;
  return true;
}

bool LoopRemoval::end_selection() {
  if (phase_ != Phase::holding) return true;
  phase_ = Phase::leaving;
  walk_.end_contour();
  if (!walk_.go_undisturbed()) {
    find_walls();
    if (!walk_.go_on()) return false;
  }
  linear_.end_at(walk_.at().start);
  static_cast<void>(settle(walked_.end()));
  if (!release_.check_left_out()) return false;
  // Neighbours are not looked for any more.
  obstacles_.clear();
  walked_.drop_boxes();
  return true;
}

void LoopRemoval::release_entry(PathBlocks& out) {
  for (PathBlockPtr& block : held_.entering) out.push_back(std::move(block));
  held_.entering.clear();
}

bool LoopRemoval::release_some(PathBlocks& out) {
  release_entry(out);
  release_.release_portion(out);
  if (!walked_.empty()) {
    // Lines in place of an arc begin where the block before it ends, and a stretch that is left out
    // after a block may begin on that block.
    const std::size_t next = release_.next();
    held_.path.forget_path_before(next - std::min<std::size_t>(next - held_.path.begin(), 1));
    return true;
  }
  release_.leave_out_rest(walk_.at().start, out);
  forget_selection();
  // Some of these blocks may come to lie after the next selection.
  behind_.taken.swap(behind_.blocks);
  for (PathBlockPtr& block : behind_.taken)
    if (!feed(std::move(block), out)) return false;
  behind_.taken.clear();
  return behind_.input == Input::more || end();
}

void LoopRemoval::forget_selection() {
  held_.clear();
  obstacles_.clear();
  obstacles_.set_walls({});
  closing_.begin();
  walked_.clear();
  walk_.begin();
  release_.begin();
  phase_ = Phase::idle;
}

ContourView LoopRemoval::contour_from(std::size_t first) const {
  ContourView view{
      .count = end_of_contour() - first,
      .segment = [this, first](std::size_t number) { return contour(first + number).programmed; },
      .tool_side = held_.path.mode_of(end_of_path() - 1).cutting_side(),
      .tolerances = tolerances_,
      .checkpoint = &checkpoint_};
  if (held_.path.has_roles())
    view.role = [this, first](std::size_t number) { return contour(first + number).contour_role; };
  if (held_.has_short) view.shift = held_.path.setting_of(end_of_path() - 1).at_end.shift;
  return view;
}

void LoopRemoval::find_walls() {
  if (held_.path.empty()) return;
  std::size_t first = 0;
  if (held_.path.begin_of_contour() > 0) {
    first = closing_.begin_of_last_lap().value_or(0);
    if (first < held_.path.begin_of_contour()) return;
  }
  Walls walls = trc::find_walls(contour_from(first), lead_settings_, held_.largest_radius);
  if (walls.are_plain()) return;
  walls.move_by(first);
  obstacles_.set_walls(std::move(walls));
  // In a window the path has been walked with leads as walls: it is walked again.
  walk_.start_over();
}

[[gnu::noinline]] bool LoopRemoval::has_no_room_for(const Source& source) {
  return diagnostics_.report(selection_too_long(source, selection_blocks_));
}

bool LoopRemoval::hold(PathBlock& block) {
  if (!has_room_for(block.programmed.source)) return false;
  held_.largest_radius = std::max(
      {held_.largest_radius, std::abs(block.at_start.shift), std::abs(block.at_end.shift)});
  held_.has_linear = held_.has_linear || LinearTransitions::are_asked_for(block.mode());
  // Lines in place of an arc make the block after it longer by up to this many radii.
  const double stretch = held_.has_linear ? block.mode().options.stretch_factor : 0;
  held_.farthest_reach = std::max(held_.farthest_reach, held_.largest_radius * (1 + stretch));
  held_.path.append(block);
  if (held_.path.end() == 1) linear_.begin_at(start_of(block.tool_path));
  if (block.role == Role::contour) {
    note_contour_block(bounding_box(block.programmed.path), Certificate::block_of(block));
  } else {
    // Round a tip whose blocks overlap, the arc turns by more than half a turn and the blocks turn
    // the other way: the certificate does not cover this.
    const auto* arc = std::get_if<Arc>(&block.tool_path);
    const bool goes_far_round = arc != nullptr && std::abs(arc->sweep) > std::numbers::pi;
    held_.gap = held_.gap || block.unreachable || goes_far_round;
  }
  return true;
}

void LoopRemoval::note_contour_block(const Box& programmed, const Certificate::Block& course) {
  const bool behind_gap = std::exchange(held_.gap, false);
  obstacles_.append(
      course, behind_gap ? Certificate::Begin::behind_gap : Certificate::Begin::joined, programmed);
  held_.has_short = held_.has_short || programmed.sizes().maxCoeff() <=
                                           longest_in_bow_tie(tolerances_.input_resolution);
  if (window_ == 0) return;
  const Segment block = contour(end_of_contour() - 1).programmed;
  release_.note_contour_block(length_of(block));
  closing_.note(end_of_contour() - 1, block, held_.largest_radius);
  walk_.note_contour_block(programmed, held_.farthest_reach);
}

bool LoopRemoval::walk() {
  if (closing_.needs_begin()) {
    if (auto walls = closing_.find_lead_in(contour_from(0), obstacles_.boxes())) {
      obstacles_.set_walls(*std::move(walls));
      walk_.start_over();
    }
  }
  return walk_.is_waiting() || walk_.go_on();
}

[[gnu::noinline]] bool LoopRemoval::proceed(PathBlocks& out) {
  if (!walk()) return false;
  if (walk_.waits_for_closing()) return true;
  std::size_t due = walked_.begin();
  while (due < walked_.end() && walk_.has_had_its_window(walked_.kept(due).block)) ++due;
  due = settle(due);
  if (walked_.begin() < due) release_entry(out);
  if (!release_.check_leaving(due)) return false;
  release_.release_to(due, out);
  forget();
  return true;
}

std::size_t LoopRemoval::settle(std::size_t due) {
  if (!held_.has_linear) return due;
  for (std::size_t piece = walked_.begin(); piece < due; ++piece) {
    if (!linear_.may_replace(piece)) continue;
    const std::size_t next = walked_.kept(piece).block + 1;
    if (phase_ == Phase::holding) {
      if (piece + 1 == walked_.end()) return std::max(piece, walked_.begin() + 1) - 1;
      if (walk_.at().block == next) continue;
    }
    linear_.replace(piece);
    walk_.forget_passes_on(next);
  }
  return due;
}

// Drops blocks that no window reaches any more.
void LoopRemoval::forget() {
  walked_.drop_boxes_before(walked_.begin());
  if (release_.next() >= end_of_path() || closing_.needs_begin()) return;
  const std::size_t number = held_.path.number_of(release_.next());
  // Some more than the window, so that dropping is rare.
  const std::size_t slack_blocks = std::min<std::size_t>(window_ / 8, 64);
  if (number <= held_.path.begin_of_contour() + window_ + 1 + slack_blocks) return;
  const std::size_t keep = number - window_ - 1;
  held_.path.forget_before(keep);
  obstacles_.drop_before(keep);
}

std::optional<RefusedWay> LoopRemoval::refused_way() const {
  if (held_.entering.empty() || held_.path.empty() || held_.path.begin_of_contour() > 0)
    return std::nullopt;
  const PathBlock& approach = *held_.entering.front();
  if (approach.role != Role::approach) return std::nullopt;
  const Walls& walls = obstacles_.walls();
  WayPastLeads past{.at_begin = walked_.empty()};
  const std::size_t end = end_of_contour();
  for (const Walls::Range& leads : walls.leads) {
    if (leads.first == 0) past.leads_in = leads.end;
    if (leads.end == end) past.leads_out = end - leads.first;
  }
  RefusedWay refused{.blocks = {approach.programmed}, .shift = approach.at_end.shift, .kind = past};
  for (std::size_t number = past.leads_in; number < end; ++number) {
    const HeldPath::ContourBlock block = contour(number);
    const HeldPath::Setting& setting = held_.path.setting_of(block.block);
    refused.blocks.push_back({.source = block.source,
                              .path = block.programmed,
                              .normal = setting.normal,
                              .feed = setting.feed,
                              .role = block.contour_role,
                              .mode = setting.mode});
  }
  return refused;
}

}  // namespace trc
