#include "core/trc/passes/relevant_blocks.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/trc/corner/corner.h"
#include "core/trc/passes/rounded_input.h"

namespace trc {
namespace {

Compensation compensation_of(const TrcMode& mode) {
  if (mode.options.suppress_trc) return {.active = true, .shift = 0};
  return {.active = true, .shift = shift_of_tool(mode)};
}

bool continues(const TrcMode& before, const TrcMode* after) {
  return after != nullptr && after->active() && after->selection_number == before.selection_number;
}

// Whether the mode takes the tool off the contour in the motion block after G40.
bool retracts_in_a_block(Selection deselection) {
  return deselection != Selection::perpendicular && deselection != Selection::without_block;
}

bool goes_on_with_contour(const TrcMode& before, const TrcMode* after) {
  return continues(before, after) && after->side == before.side;
}

// Rule 3.0: only under G236 may the approach be an arc. Under G238 it is refused later, when the
// whole contour is known.
bool is_circle_for_line(const PathBlock& block, const TrcMode* next) {
  if (block.role != Role::approach || !is_arc(block.programmed.path)) return false;
  const TrcMode& mode = block.mode();
  if (mode.selection == Selection::inside_corner && goes_on_with_contour(mode, next)) return false;
  return mode.selection != Selection::on_path || mode.tangential;
}

}  // namespace

const char* RelevantBlocks::excluded_pair(const TrcMode& mode) {
  if (mode.tangential && mode.selection == Selection::perpendicular) return "G05 with G237";
  return nullptr;
}

bool RelevantBlocks::feed(Block&& block, PathBlocks& out) {
  return std::visit(
      overloaded{
          [&](MotionBlock& motion) { return follow(std::move(motion), out); },
          [&](PassiveBlock& passive) { return attach_passive(std::move(passive), out); },
      },
      block);
}

bool RelevantBlocks::drain(PathBlocks& out) {
  return release(end_mode_ ? &*end_mode_ : nullptr, out);
}

bool RelevantBlocks::attach_passive(PassiveBlock&& block, PathBlocks& out) {
  // A motion to where the tool stands.
  if (!block.moves && block.text.empty() && block.mode->active() && !last_.active)
    without_length_ = block.source;
  if (!held_) {
    auto carrier = std::make_unique<PathBlock>();
    carrier->role = Role::passive;
    carrier->programmed.source = block.source;
    carrier->programmed.mode = block.mode;
    carrier->passive.push_back(std::move(block));
    out.push_back(std::move(carrier));
    return true;
  }
  if (held_->passive.size() + held_->passive_after_exit.size() >= setup_.limits.passive_blocks) {
    Diagnostic overflow = diagnostic(Code::too_many_passive_blocks, block.source);
    overflow.values = {{"limit", static_cast<double>(setup_.limits.passive_blocks)}};
    return diagnostics_.report(std::move(overflow));
  }
  const bool after_exit =
      !block.mode->active() && block.mode->deselection == Selection::perpendicular;
  auto& carried = after_exit ? held_->passive_after_exit : held_->passive;
  carried.push_back(std::move(block));
  return true;
}

bool RelevantBlocks::follow(MotionBlock&& motion, PathBlocks& out) {
  if (held_ && is_circle_for_line(*held_, motion.mode.get())) keep_refused_approach(motion);
  if (held_) held_->before_short = RoundedInput::is_short(motion, setup_.leads.input_resolution);
  if (!release(motion.mode.get(), out)) return false;
  auto block = std::make_unique_for_overwrite<PathBlock>();
  block->programmed = std::move(motion);
  if (!classify(*block)) return false;
  last_ = block->at_end;
  if (!last_.active) without_length_ = {};
  if (last_mode_ != block->programmed.mode) last_mode_ = block->programmed.mode;
  last_path_ = block->programmed.path;
  if (block->at_end.active) {
    held_ = std::move(block);
  } else {
    out.push_back(std::move(block));
  }
  return true;
}

bool RelevantBlocks::release(const TrcMode* next, PathBlocks& out) {
  if (!held_) return true;
  PathBlockPtr released = std::move(held_);
  PathBlock& block = *released;
  const TrcMode& mode = block.mode();
  const bool contour_follows = goes_on_with_contour(mode, next);
  if (is_circle_for_line(block, next)) return refuse_circle(block);
  if (block.role == Role::side_change && !contour_follows)
    return refuse(Code::side_change_without_contour, block);
  if (block.role == Role::approach && !contour_follows) {
    if (continues(mode, next)) return refuse(Code::side_change_without_contour, block);
    refuse(Code::selection_without_contour, block);
    block.role = Role::uncompensated;
    block.origin = Origin::uncompensated;
    block.at_end = {};
    last_ = {};
  } else if (next != nullptr && !continues(mode, next) && !leave_selection(block, *next)) {
    return false;
  }
  out.push_back(std::move(released));
  return true;
}

bool RelevantBlocks::leave_selection(PathBlock& block, const TrcMode& next) {
  if (retracts_in_a_block(next.deselection))
    return !next.active() || refuse(Code::deselection_without_motion, block);
  block.perpendicular_exit = next.deselection == Selection::perpendicular;
  last_ = {};
  return true;
}

bool RelevantBlocks::classify(PathBlock& block) {
  const TrcMode& mode = block.mode();
  if (mode.active() && block.programmed.mode != last_mode_) {
    if (const char* pair = excluded_pair(mode)) return refuse(Code::not_available, block, pair);
  }
  if (!mode.active()) return end_selection(block);
  return last_.active ? continue_selection(block) : begin_selection(block);
}

bool RelevantBlocks::begin_selection(PathBlock& block) {
  const TrcMode& mode = block.mode();
  contour_blocks_ = 0;
  block.at_end = compensation_of(mode);
  if (mode.selection == Selection::perpendicular) {
    block.role = Role::contour;
    block.origin = Origin::programmed;
    block.at_start = block.at_end;
    block.perpendicular_entry = true;
    return true;
  }
  block.role = Role::approach;
  block.origin = Origin::approach;
  return true;
}

bool RelevantBlocks::continue_selection(PathBlock& block) {
  const TrcMode& mode = block.mode();
  block.at_end = compensation_of(mode);
  block.at_start = last_;
  block.role = Role::contour;
  block.origin = Origin::programmed;
  if (counts_for_window(block)) count_for_window(block);
  if (mode.side == last_mode_->side) return true;
  // Both sides of such a block lie on a contour: there is no free end to begin the arc of G05 at
  // (D-151).
  if (mode.tangential) return refuse(Code::not_available, block, "G05 with a change of side");
  if (mode.selection == Selection::inside_corner)
    return refuse(Code::side_change_under_inside_corner, block);
  // The change takes place at the corner, whatever its angle (D-22).
  if (mode.options.reverse) {
    block.at_start = block.at_end;
    return reverses(block) || warn_of_corner(block);
  }
  block.role = Role::side_change;
  block.origin = Origin::approach;
  if (is_arc(block.programmed.path)) return refuse(Code::circular_side_change_block, block);
  return true;
}

// Blocks beyond the window are not searched: reported once per selection (D-10).
void RelevantBlocks::count_for_window(const PathBlock& block) {
  const std::size_t window = setup_.limits.look_ahead_blocks;
  if (++contour_blocks_ <= window) return;
  Diagnostic warning = diagnostic(Code::beyond_window, block.programmed.source);
  warning.values = {{"look_ahead_blocks", static_cast<double>(window)}};
  diagnostics_.report(std::move(warning));
}

// A retract may be an arc only under G236, or become one by G05 (D-01).
bool RelevantBlocks::end_selection(PathBlock& block) {
  if (!last_.active) return true;
  const TrcMode& mode = block.mode();
  block.role = Role::retract;
  block.origin = Origin::retract;
  block.at_start = last_;
  const bool may_be_circular = mode.deselection == Selection::on_path && !mode.tangential;
  if (!is_arc(block.programmed.path) || may_be_circular) return true;
  keep_refused_retract(block);
  return refuse(Code::circular_deselection_block, block);
}

void RelevantBlocks::keep_refused_approach(const MotionBlock& next) {
  const MotionBlock& approach = held_->programmed;
  if (!continues(*approach.mode, next.mode.get()) || end_of(approach.path) != start_of(next.path))
    return;
  refused_way_ = {.blocks = {approach, next}, .shift = held_->at_end.shift, .kind = WayIn{}};
}

// Under G238 the tool is not at the end of the last block: the whole contour decides where it
// leaves (D-152).
void RelevantBlocks::keep_refused_retract(const PathBlock& retract) {
  if (last_mode_->selection == Selection::inside_corner ||
      end_of(last_path_) != start_of(retract.programmed.path))
    return;
  MotionBlock last = retract.programmed;
  last.mode = last_mode_;
  last.path = last_path_;
  refused_way_ = {
      .blocks = {last, retract.programmed}, .shift = retract.at_start.shift, .kind = WayOut{}};
}

// Whether the motion goes straight back, so that both equidistants end in one point.
bool RelevantBlocks::reverses(const PathBlock& block) const {
  return turns_back(tangent_at_end(last_path_), tangent_at_start(block.programmed.path),
                    setup_.tolerances);
}

bool RelevantBlocks::warn_of_corner(const PathBlock& block) {
  const double turn =
      turn_between(tangent_at_end(last_path_), tangent_at_start(block.programmed.path));
  const Position corner =
      from_plane(block.mode().plane, start_of(block.programmed.path), block.programmed.normal.from);
  Diagnostic warning = diagnostic(Code::side_changed_at_corner, block.programmed.source);
  warning.values = {{"turn", std::abs(turn) * 180 / std::numbers::pi},
                    {"tool_radius", block.mode().cutting_radius()}};
  warning.point = DiagnosticPoint{.x = corner[0], .y = corner[1], .z = corner[2]};
  return diagnostics_.report(std::move(warning));
}

bool RelevantBlocks::refuse_circle(const PathBlock& block) {
  Diagnostic refused = diagnostic(Code::circular_selection_block, block.programmed.source);
  if (without_length_.line > 0) {
    refused.detail = "the motion before it has no length";
    append_place(refused.values, "selection", without_length_);
  }
  return diagnostics_.report(std::move(refused));
}

bool RelevantBlocks::refuse(Code code, const PathBlock& block, std::string detail) {
  return diagnostics_.report(diagnostic(code, block.programmed.source, std::move(detail)));
}

}  // namespace trc
