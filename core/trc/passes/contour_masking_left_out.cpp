#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/trc/passes/contour_masking.h"
#include "core/trc/walls/closing.h"
#include "core/trc/walls/sided_walls.h"

// How ContourMasking reports the blocks it leaves out, and refuses too many of them (D-39).

namespace trc {

void ContourMasking::find_walls() {
  if (base_ > 0) return;
  const std::size_t first = held_.front()->role == Role::contour ? 0 : 1;
  double radius = 0;
  bool has_roles = false;
  for (const PathBlockPtr& block : held_) {
    radius = std::max(radius, std::abs(block->at_end.shift));
    has_roles = has_roles || block->programmed.role != ContourRole::unspecified;
  }
  ContourView view{
      .count = held_.size() - first,
      .segment = [&](std::size_t number) { return held(first + number).programmed.path; },
      .tolerances = tolerances_,
      .checkpoint = &checkpoint_};
  if (view.count > 0) view.tool_side = held(first).mode().cutting_side();
  if (has_roles)
    view.role = [&](std::size_t number) { return held(first + number).programmed.role; };
  walls_ = trc::find_walls(view, lead_settings_, radius);
}

double ContourMasking::wall_length(std::size_t index) const {
  const PathBlock& block = held(index);
  if (block.role != Role::contour) return 0;
  const std::size_t number = number_of(index);
  if (walls_.is_lead(number)) return 0;
  return length_of(part_of(block.programmed.path, walls_.part_of(number)));
}

// Of the blocks beside masked ones, the part that joining anew cuts off is not touched either. Less
// than the tool is wide, it mostly is after all: by the transition of the next outside corner.
double ContourMasking::cut_off_beside(std::size_t first, std::size_t end) const {
  if (end == base_ + held_.size() || !held(end).rejoin) return 0;
  const PathBlock::Rejoin& rejoin = *held(end).rejoin;
  const double tool_width = 2 * std::abs(held(end).at_start.shift);
  const auto length = [&](std::size_t index, double cut) {
    const auto* arc = std::get_if<Arc>(&held(index).programmed.path);
    const double cut_off = cut * (arc != nullptr ? radius_of(*arc) : 1);
    return cut_off > tool_width ? std::min(cut_off, wall_length(index)) : 0;
  };
  return length(first - 1, rejoin.cut_before) + length(end, rejoin.cut_after);
}

LeftOut ContourMasking::left_out(std::size_t first, std::size_t& end) const {
  LeftOut stretch{
      .first = held(first).programmed.source,
      .tool_radius = held(first).mode().cutting_radius(std::abs(held(first).at_end.shift))};
  std::size_t index = first;
  for (; index < end && held(index).masked; ++index) {
    stretch.length += wall_length(index);
    stretch.last = held(index).programmed.source;
  }
  end = index;
  stretch.length += cut_off_beside(first, end);
  return stretch;
}

// One note for each run of masked blocks.
void ContourMasking::report_masked(std::size_t first, std::size_t end) {
  for (std::size_t index = first; index < end; ++index) {
    if (window_ > 0) contour_length_ += wall_length(index);
    if (!begins_masked(index)) continue;
    std::size_t behind = end;
    const LeftOut stretch = left_out(index, behind);
    if (window_ > 0) longest_left_out_.add(stretch);
    diagnostics_.report(note_of(stretch));
  }
}

bool ContourMasking::holds_a_whole(std::size_t first, std::size_t end,
                                   const LeftOut& stretch) const {
  // The lap of a small post is shorter than a stretch that counts as long.
  if (holds_a_lap(walls_, number_of(first), number_of(end - 1), stretch)) return true;
  if (!stretch.is_long()) return false;
  const auto moves = [](const PassiveBlock& block) { return block.normal.moves(); };
  for (std::size_t index = first; index < end; ++index)
    if (std::any_of(held(index).passive.begin(), held(index).passive.end(), moves)) return true;
  return false;
}

bool ContourMasking::check_left_out() {
  LeftOut longest = std::exchange(longest_left_out_, {});
  double of_walls = std::exchange(contour_length_, 0);
  if (largest_masked_share_ >= 1) return true;
  const std::size_t end = base_ + held_.size();
  for (std::size_t index = base_; index < end; ++index) {
    of_walls += wall_length(index);
    std::size_t behind = end;
    if (begins_masked(index)) longest.add(left_out(index, behind));
  }
  if (longest.length == 0) return true;
  longest.of_walls = of_walls;
  for (std::size_t index = base_; index < end; ++index) {
    if (!begins_masked(index)) continue;
    std::size_t behind = end;
    LeftOut stretch = left_out(index, behind);
    stretch.of_walls = of_walls;
    if (holds_a_whole(index, behind, stretch))
      return diagnostics_.report(refusal_of(stretch, std::nullopt));
  }
  if (!longest.is_more_than(largest_masked_share_)) return true;
  return diagnostics_.report(refusal_of(longest, largest_masked_share_));
}

}  // namespace trc
