#include "core/trc/held_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trc/offset.h"

namespace trc {

void HeldPath::append(PathBlock& block) {
  const bool is_contour = block.role == Role::contour;
  if (is_contour) note_contour_block(block);
  if (!block.riders.empty()) riders_.push_back({blocks_.end(), std::move(block.riders)});
  const bool apart = !is_contour && stands_apart(block);
  if (apart) {
    const Source& source = block.programmed.source;
    apart_.push_back({.block = blocks_.end(),
                      .cut_at_start = block.cut_at_start,
                      .cut_at_end = block.cut_at_end,
                      .index = source.index,
                      .n_word = source.number,
                      .line = source.line});
  }
  const Number setting = setting_of(block);
  Block& held = blocks_.next();
  held.path = block.tool_path;
  held.number = static_cast<Number>(contour_.end() > 0 ? contour_.end() - 1 : 0);
  held.setting = setting;
  held.role = block.role;
  held.origin = block.origin;
  held.unreachable = block.unreachable;
  held.apart = apart;
}

bool HeldPath::stands_apart(const PathBlock& inserted) const {
  return contour_.end() == 0 || inserted.cut_at_start != 0 || inserted.cut_at_end != 0 ||
         inserted.programmed.source != contour_.back().source();
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
  const MotionBlock& programmed = block.programmed;
  ContourBlock& contour = contour_.next();
  contour.programmed = programmed.path;
  contour.cut_at_start = block.cut_at_start;
  contour.cut_at_end = block.cut_at_end;
  contour.index = programmed.source.index;
  contour.n_word = programmed.source.number;
  contour.line = programmed.source.line;
  contour.block = static_cast<Number>(blocks_.end());
}

void HeldPath::restore(std::size_t number, PathBlock& block) {
  const Block& held = blocks_[number];
  const Setting& setting = settings_[held.setting];
  MotionBlock& programmed = block.programmed;
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
  block.unreachable = held.unreachable;
  if (held.apart) {
    restore_apart(number, block);
  } else {
    const ContourBlock& contour = contour_[held.number];
    programmed.source = contour.source();
    block.cut_at_start = held.is_contour() ? contour.cut_at_start : 0;
    block.cut_at_end = held.is_contour() ? contour.cut_at_end : 0;
    if (held.is_contour()) {
      programmed.path = contour.programmed;
      give_offsets(block);
    }
  }
  while (!riders_.empty() && riders_[riders_.begin()].block <= number) {
    Riders& riders = riders_[riders_.begin()];
    if (riders.block == number) block.riders = std::move(riders.blocks);
    riders_.drop_before(riders_.begin() + 1);
  }
}

void HeldPath::restore_apart(std::size_t number, PathBlock& block) {
  while (apart_[apart_.begin()].block < number) apart_.drop_before(apart_.begin() + 1);
  const Apart& apart = apart_[apart_.begin()];
  block.programmed.source = {apart.index, apart.n_word, apart.line};
  block.cut_at_start = apart.cut_at_start;
  block.cut_at_end = apart.cut_at_end;
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
