#include "core/trc/held_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trc/offset.h"

namespace trc {

void HeldPath::append(PathBlock& block) {
  MotionBlock& programmed = block.programmed;
  if (block.role == Role::contour) note_contour_block(block);
  if (!block.riders.empty()) riders_.push_back({blocks_.end(), std::move(block.riders)});
  const double radius = std::min(std::abs(block.at_start.shift), std::abs(block.at_end.shift));
  const Number setting = number_of_setting({.mode = std::move(programmed.mode),
                                            .feed = programmed.feed,
                                            .normal = programmed.normal,
                                            .tracking = std::move(programmed.tracking),
                                            .at_start = block.at_start,
                                            .at_end = block.at_end,
                                            .rapid = programmed.rapid,
                                            .perpendicular_entry = block.perpendicular_entry,
                                            .perpendicular_exit = block.perpendicular_exit,
                                            .radius = radius});
  const std::size_t number = contour_.end() > 0 ? contour_.end() - 1 : 0;
  blocks_.push_back({.path = block.tool_path,
                     .cut_at_start = block.cut_at_start,
                     .cut_at_end = block.cut_at_end,
                     .index = programmed.source.index,
                     .n_word = programmed.source.number,
                     .line = programmed.source.line,
                     .number = static_cast<Number>(number),
                     .setting = setting,
                     .role = block.role,
                     .origin = block.origin,
                     .unreachable = block.unreachable});
}

HeldPath::Number HeldPath::number_of_setting(Setting wanted) {
  if (settings_.empty() || settings_.back() != wanted) settings_.push_back(std::move(wanted));
  return static_cast<Number>(settings_.end() - 1);
}

void HeldPath::note_contour_block(const PathBlock& block) {
  const double at_start = std::abs(block.at_start.shift);
  // What is inserted before a change of radius may be travelled with either.
  for (std::size_t number = blocks_.end(); number-- > blocks_.begin();) {
    Block& inserted = blocks_[number];
    if (inserted.is_contour()) break;
    Setting changed = settings_[inserted.setting];
    if (changed.radius <= at_start) continue;
    changed.radius = at_start;
    inserted.setting = number_of_setting(std::move(changed));
  }
  contour_.push_back(
      {.programmed = block.programmed.path, .block = static_cast<Number>(blocks_.end())});
}

PathBlockPtr HeldPath::restored(std::size_t number) {
  const Block& held = blocks_[number];
  const Setting& setting = settings_[held.setting];
  auto block = std::make_unique<PathBlock>();
  block->programmed = {.source = held.source(),
                       .normal = setting.normal,
                       .feed = setting.feed,
                       .rapid = setting.rapid,
                       .mode = setting.mode,
                       .tracking = setting.tracking};
  block->role = held.role;
  block->origin = held.origin;
  block->perpendicular_entry = setting.perpendicular_entry;
  block->perpendicular_exit = setting.perpendicular_exit;
  block->at_start = setting.at_start;
  block->at_end = setting.at_end;
  block->tool_path = held.path;
  block->cut_at_start = held.cut_at_start;
  block->cut_at_end = held.cut_at_end;
  block->unreachable = held.unreachable;
  if (held.is_contour()) {
    block->programmed.path = contour_[held.number].programmed;
    give_offsets(*block);
  }
  while (!riders_.empty() && riders_[riders_.begin()].block <= number) {
    Riders& riders = riders_[riders_.begin()];
    if (riders.block == number) block->riders = std::move(riders.blocks);
    riders_.drop_before(riders_.begin() + 1);
  }
  return block;
}

void HeldPath::forget_before(std::size_t contour_number) {
  forget_path_before(contour_[contour_number].block);
}

void HeldPath::forget_path_before(std::size_t block) {
  settings_.drop_before(blocks_[block].setting);
  contour_.drop_before(blocks_[block].number);
  blocks_.drop_before(block);
}

}  // namespace trc
