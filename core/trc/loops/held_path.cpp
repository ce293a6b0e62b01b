#include "core/trc/loops/held_path.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "core/trc/corner/offsets.h"
#include "core/trc/loops/held_path_append.h"

namespace trc {

void HeldPath::append(PathBlock& block) {
  const bool is_contour = block.role == Role::contour;
  if (is_contour) {
    const MotionBlock& programmed = block.programmed;
    limit_radius_of_inserted(std::abs(block.at_start.shift));
    const Cuts cuts{block.cut_at_start, block.cut_at_end};
    std::visit([&](const auto& path) { keep_contour(programmed, path, cuts); }, programmed.path);
  }
  if (!block.passive.empty()) passive_.push_back({blocks_.end(), std::move(block.passive)});
  const bool has_own = !is_contour && needs_own_data(block);
  if (has_own)
    own_data_.push_back({.block = blocks_.end(),
                         .cuts = {block.cut_at_start, block.cut_at_end},
                         .source = block.programmed.source});
  const Number setting = note_setting(block);
  const Reach reach = block.unreachable ? Reach::unreachable : Reach::reachable;
  std::visit(
      [&](const auto& path) {
        keep_path(path, setting, block.role, block.origin, reach).has_own = has_own;
      },
      block.tool_path);
}

bool HeldPath::follows_like(const PathBlock& block) const {
  if (settings_.empty()) return false;
  const Setting& last = settings_.back();
  return last.mode == block.programmed.mode && last.at_start == block.at_start &&
         last.at_end == block.at_end && last.at_start == last.at_end && !last.perpendicular_entry &&
         !last.perpendicular_exit && last.radius == std::abs(last.at_end.shift);
}

bool HeldPath::stays_put(std::size_t block) const {
  const Setting& setting = setting_of(block);
  const auto moves = [](const AxisTravel& axis) { return axis.moves(); };
  return !setting.normal.moves() &&
         std::none_of(setting.tracking.begin(), setting.tracking.end(), moves);
}

bool HeldPath::changes_depth(std::size_t first, std::size_t end) const {
  const auto moves = [](const PassiveBlock& block) { return block.normal.moves(); };
  for (std::size_t number = passive_.begin(); number < passive_.end(); ++number) {
    const auto& [block, passive] = passive_[number];
    if (block >= end) return false;
    if (block >= first && std::any_of(passive.begin(), passive.end(), moves)) return true;
  }
  return false;
}

bool HeldPath::needs_own_data(const PathBlock& inserted) const {
  return contour_.empty() || inserted.cut_at_start != 0 || inserted.cut_at_end != 0 ||
         inserted.programmed.source != source_of(contour_.end() - 1);
}

HeldPath::Number HeldPath::note_setting(const PathBlock& block) {
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
  return last_setting();
}

HeldPath::Number HeldPath::note_changed_setting(const MotionBlock& motion) {
  Setting changed = settings_.back();
  changed.feed = motion.feed;
  changed.normal = motion.normal;
  changed.rapid = motion.rapid;
  changed.tracking = motion.tracking;
  settings_.push_back(std::move(changed));
  return last_setting();
}

// Blocks inserted before a change of radius may be travelled with either radius. Settings are
// forgotten in the order of their blocks: from the first changed one on, each block has its own.
void HeldPath::limit_radius_of_inserted(double radius) {
  const auto is_larger = [&](const KeptBlock& inserted) {
    return settings_[inserted.setting].radius > radius;
  };
  std::size_t first = blocks_.end();
  for (std::size_t number = first; number-- > blocks_.begin();) {
    if (blocks_[number].role == Role::contour) break;
    if (is_larger(blocks_[number])) first = number;
  }
  for (std::size_t number = first; number < blocks_.end(); ++number) {
    KeptBlock& inserted = blocks_[number];
    Setting changed = settings_[inserted.setting];
    changed.radius = std::min(changed.radius, radius);
    settings_.push_back(std::move(changed));
    inserted.setting = last_setting();
  }
}

PathBlockPtr HeldPath::restored(std::size_t number) {
  auto owner = std::make_unique<PathBlock>();
  PathBlock& block = *owner;
  const KeptBlock& kept = blocks_[number];
  const Setting& setting = settings_[kept.setting];
  MotionBlock& programmed = block.programmed;
  programmed.normal = setting.normal;
  programmed.feed = setting.feed;
  programmed.rapid = setting.rapid;
  programmed.mode = setting.mode;
  programmed.tracking = setting.tracking;
  block.role = kept.role;
  block.origin = kept.origin;
  block.perpendicular_entry = setting.perpendicular_entry;
  block.perpendicular_exit = setting.perpendicular_exit;
  block.at_start = setting.at_start;
  block.at_end = setting.at_end;
  block.tool_path = this->block(number).path;
  block.unreachable = kept.unreachable;
  if (kept.has_own) {
    restore_own_data(number, block);
  } else {
    programmed.source = source_of(kept.number);
    if (kept.role == Role::contour) {
      const auto give = [&](const auto& path, const Cuts& cuts) {
        programmed.path = path;
        block.cut_at_start = cuts.at_start;
        block.cut_at_end = cuts.at_end;
      };
      visit_programmed(kept.number, overloaded{give, [&](const Line& line) { give(line, {}); }});
      programmed.role = contour_[kept.number].contour_role;
      give_offsets(block);
    }
  }
  while (!passive_.empty() && passive_[passive_.begin()].block <= number) {
    PassiveBehind& passive = passive_[passive_.begin()];
    if (passive.block == number) block.passive = std::move(passive.blocks);
    passive_.drop_before(passive_.begin() + 1);
  }
  return owner;
}

HeldPath::Lines HeldPath::lines_of(std::size_t transition) const {
  const KeptBlock& kept = blocks_[transition];
  const Point places[] = {ends_at(transition - 1), kept.start, kept.end, begins_at(transition + 1)};
  Lines found;
  for (std::size_t leg = 0; leg < 3; ++leg)
    if (places[leg] != places[leg + 1])
      found.lines[found.count++] = {.start = places[leg], .end = places[leg + 1]};
  return found;
}

void HeldPath::lengthen_end(std::size_t block, const Point& place, double by) {
  KeptBlock& kept = blocks_[block];
  kept.end = place;
  if (!kept.is_arc) return;
  arcs_[kept.arc].sweep += std::copysign(by, arcs_[kept.arc].sweep);
  circles_[contour_[kept.number].circle].cuts.at_end -= by;
}

void HeldPath::lengthen_start(std::size_t block, const Point& place, double by) {
  KeptBlock& kept = blocks_[block];
  kept.start = place;
  if (!kept.is_arc) return;
  arcs_[kept.arc].sweep += std::copysign(by, arcs_[kept.arc].sweep);
  circles_[contour_[kept.number].circle].cuts.at_start -= by;
}

void HeldPath::restore_own_data(std::size_t number, PathBlock& block) {
  while (own_data_[own_data_.begin()].block < number) own_data_.drop_before(own_data_.begin() + 1);
  const OwnData& own = own_data_[own_data_.begin()];
  block.programmed.source = own.source;
  block.cut_at_start = own.cuts.at_start;
  block.cut_at_end = own.cuts.at_end;
}

void HeldPath::forget_before(std::size_t contour_number) {
  forget_path_before(contour_[contour_number].block);
}

void HeldPath::clear() {
  blocks_.clear();
  arcs_.clear();
  contour_.clear();
  circles_.clear();
  settings_.clear();
  passive_.clear();
  own_data_.clear();
  has_roles_ = false;
}

void HeldPath::forget_path_before(std::size_t block) {
  const KeptBlock& first = blocks_[block];
  settings_.drop_before(first.setting);
  if (!contour_.empty()) circles_.drop_before(contour_[first.number].circle);
  contour_.drop_before(first.number);
  arcs_.drop_before(first.arc);
  blocks_.drop_before(block);
}

}  // namespace trc
