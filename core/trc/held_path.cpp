#include "core/trc/held_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trc/offset.h"

namespace trc {

void HeldPath::append(PathBlock& block) {
  if (block.role == Role::contour) note_contour_block(block);
  if (!block.riders.empty()) riders_.push_back({blocks_.end(), std::move(block.riders)});
  const std::size_t number = contour_.end() > 0 ? contour_.end() - 1 : 0;
  const Source& source = block.programmed.source;
  blocks_.push_back({.path = block.tool_path,
                     .cut_at_start = block.cut_at_start,
                     .cut_at_end = block.cut_at_end,
                     .index = source.index,
                     .n_word = source.number,
                     .line = source.line,
                     .number = static_cast<Number>(number),
                     .setting = setting_of(block),
                     .role = block.role,
                     .origin = block.origin,
                     .unreachable = block.unreachable});
}

HeldPath::Number HeldPath::setting_of(const PathBlock& block) {
  const MotionBlock& programmed = block.programmed;
  const double radius = std::min(std::abs(block.at_start.shift), std::abs(block.at_end.shift));
  const auto is_that_of = [&](const Setting& setting) {
    return setting.mode == programmed.mode && setting.feed == programmed.feed &&
           setting.normal == programmed.normal && setting.tracking == programmed.tracking &&
           setting.at_start == block.at_start && setting.at_end == block.at_end &&
           setting.rapid == programmed.rapid &&
           setting.perpendicular_entry == block.perpendicular_entry &&
           setting.perpendicular_exit == block.perpendicular_exit && setting.radius == radius;
  };
  if (settings_.empty() || !is_that_of(settings_.back()))
    settings_.push_back({.mode = programmed.mode,
                         .feed = programmed.feed,
                         .normal = programmed.normal,
                         .tracking = programmed.tracking,
                         .at_start = block.at_start,
                         .at_end = block.at_end,
                         .rapid = programmed.rapid,
                         .perpendicular_entry = block.perpendicular_entry,
                         .perpendicular_exit = block.perpendicular_exit,
                         .radius = radius});
  return static_cast<Number>(settings_.end() - 1);
}

void HeldPath::note_contour_block(const PathBlock& block) {
  const double at_start = std::abs(block.at_start.shift);
  // What is inserted before a change of radius may be travelled with either.
  for (std::size_t number = blocks_.end(); number-- > blocks_.begin();) {
    Block& inserted = blocks_[number];
    if (inserted.is_contour()) break;
    if (settings_[inserted.setting].radius <= at_start) continue;
    Setting changed = settings_[inserted.setting];
    changed.radius = at_start;
    settings_.push_back(std::move(changed));
    inserted.setting = static_cast<Number>(settings_.end() - 1);
  }
  contour_.push_back(
      {.programmed = block.programmed.path, .block = static_cast<Number>(blocks_.end())});
}

void HeldPath::restore(std::size_t number, PathBlock& block) {
  const Block& held = blocks_[number];
  const Setting& setting = settings_[held.setting];
  MotionBlock& programmed = block.programmed;
  programmed.source = held.source();
  programmed.normal = setting.normal;
  programmed.feed = setting.feed;
  programmed.rapid = setting.rapid;
  if (programmed.mode != setting.mode) programmed.mode = setting.mode;
  programmed.tracking = setting.tracking;
  block.role = held.role;
  block.origin = held.origin;
  block.perpendicular_entry = setting.perpendicular_entry;
  block.perpendicular_exit = setting.perpendicular_exit;
  block.at_start = setting.at_start;
  block.at_end = setting.at_end;
  block.tool_path = held.path;
  block.cut_at_start = held.cut_at_start;
  block.cut_at_end = held.cut_at_end;
  block.unreachable = held.unreachable;
  if (held.is_contour()) {
    programmed.path = contour_[held.number].programmed;
    give_offsets(block);
  }
  while (!riders_.empty() && riders_[riders_.begin()].block <= number) {
    Riders& riders = riders_[riders_.begin()];
    if (riders.block == number) block.riders = std::move(riders.blocks);
    riders_.drop_before(riders_.begin() + 1);
  }
}

PathBlockPtr HeldPath::restored(std::size_t number) {
  auto block = std::make_unique<PathBlock>();
  restore(number, *block);
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
