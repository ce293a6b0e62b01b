#include "core/trc/obstacles.h"

#include <algorithm>

#include "core/geometry/distance.h"

namespace trc {

void Obstacles::append(const PathBlock& block, const Box& area, bool apart) {
  certificate_.append(block, apart);
  boxes_.append(area);
}

void Obstacles::drop_before(std::size_t number) {
  boxes_.drop_before(number);
  certificate_.drop_before(number);
}

void Obstacles::clear() {
  boxes_ = BoxTree();
  certificate_ = Certificate(tolerances_);
  first_surveyed_ = 0;
  end_of_survey_ = 0;
  near_.clear();
}

void Obstacles::rebuild_boxes() {
  const auto& contour = path_.contour();
  boxes_ = BoxTree(contour.begin());
  for (std::size_t number = contour.begin(); number < contour.end(); ++number)
    boxes_.append(bounding_box(contour[number].programmed));
}

BoxTree::Range Obstacles::certified(std::size_t block) const {
  const std::size_t number = path(block).number;
  if (path(block).unreachable) return {};
  if (path(block).is_contour())
    return {certificate_.chain_before(number), certificate_.chain_behind(number)};
  // A transition belongs to the blocks on both sides of the corner.
  const std::size_t behind = number + 1;
  if (behind >= end_of_contour() || certificate_.chain_before(behind) > number) return {};
  return {certificate_.chain_before(behind), certificate_.chain_behind(number)};
}

void Obstacles::find_neighbours(std::size_t block, double limit) const {
  const Box area = bounding_box(path(block).path);
  const BoxTree::Range skipped = certified(block);
  const std::size_t own = path(block).number;
  // Only an arc turned inside out comes too near to its own block.
  const bool sees_own = !path(block).is_contour() || path(block).unreachable;
  neighbours_.clear();
  // All that can be seen is certified.
  if (window_ > 0 && skipped.first + window_ <= std::max(own, path_.contour().begin() + window_) &&
      skipped.last + 1 >= std::min(own + window_ + 1, end_of_contour()))
    return;
  const auto add = [&](std::size_t number) {
    checkpoint_.pass();
    const bool visible = window_ == 0 || (number <= own + window_ && own <= number + window_);
    if (visible && (sees_own || number != own)) neighbours_.push_back(number);
  };
  if (block < first_surveyed_ || block >= end_of_survey_) {
    boxes_.for_each_near(area, limit, skipped, add);
    return;
  }
  near_.for_each_near(area, limit, [&](std::size_t number) {
    if (number < skipped.first || number > skipped.last) add(number);
  });
}

std::optional<Obstacles::Onset> Obstacles::onset(std::size_t block, double from, double to,
                                                 Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return std::nullopt;
  find_neighbours(block, limit);
  if (neighbours_.empty()) return std::nullopt;
  const Segment segment = path(block).path;
  PathPart part(segment, from, to);
  std::optional<Onset> first;
  const auto compare = [&](std::size_t number) {
    const auto entry = part.first_entry(programmed(number), limit);
    if (!entry) return false;
    first = {*entry, number};
    part = PathPart(segment, from, *entry);
    return true;
  };
  // What is nearest halfway is run into before that: with less and less of the block at stake
  // most of the others are out of question.
  while (are_many() && part.half_length() > 0) {
    const std::optional<std::size_t> nearest = drop_those_off(part, limit);
    if (!nearest || !compare(*nearest)) break;
  }
  for (const std::size_t number : neighbours_) compare(number);
  return first;
}

bool Obstacles::comes_nearer(std::size_t block, double from, double to, Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return false;
  find_neighbours(block, limit);
  if (neighbours_.empty()) return false;
  const PathPart part(path(block).path, from, to);
  const auto is_entered = [&](std::size_t number) {
    return part.first_entry(programmed(number), limit).has_value();
  };
  if (are_many()) {
    const std::optional<std::size_t> nearest = drop_those_off(part, limit);
    if (nearest && is_entered(*nearest)) return true;
  }
  return std::any_of(neighbours_.begin(), neighbours_.end(), is_entered);
}

std::optional<std::size_t> Obstacles::drop_those_off(const PathPart& part, double limit) const {
  const double half = part.half_length();
  std::optional<std::size_t> nearest;
  double least = limit;
  std::erase_if(neighbours_, [&](std::size_t number) {
    const double apart = distance(part.middle(), programmed(number));
    if (apart < least) {
      nearest = number;
      least = apart;
    }
    return apart >= limit + half;
  });
  return nearest;
}

std::vector<std::size_t> Obstacles::at(std::size_t block, const Onset& onset,
                                       Nearness nearness) const {
  std::vector<std::size_t> numbers{onset.obstacle};
  const Point place = point_along(path(block).path, onset.along);
  const double limit = reach(block, nearness) + tolerances_.same_point;
  boxes_.for_each_near(Box(place), limit, [&](std::size_t number) {
    const HeldPath::ContourBlock& other = path_.contour()[number];
    if (number == onset.obstacle || other.block == block) return;
    if (distance(place, other.programmed) <= limit) numbers.push_back(number);
  });
  return numbers;
}

bool Obstacles::is_clear(std::size_t block) {
  if (block < first_surveyed_ || block >= end_of_survey_) survey(block);
  return near_.empty();
}

// Asks for many blocks at once: they have nearly the same neighbours, and mostly none.
void Obstacles::survey(std::size_t first) {
  constexpr std::size_t group = 32;
  first_surveyed_ = first;
  end_of_survey_ = std::min(first + group, path_.blocks().end());
  near_.clear();
  Box area;
  double radius = 0;
  BoxTree::Range common{0, end_of_contour()};
  for (std::size_t block = first; block < end_of_survey_; ++block) {
    area.extend(bounding_box(path(block).path));
    radius = std::max(radius, path_.radius_of_tool(block));
    const BoxTree::Range own = certified(block);
    common = {std::max(common.first, own.first), std::min(common.last, own.last)};
  }
  boxes_.for_each_near(area, radius, common,
                       [&](std::size_t number) { near_.add(number, boxes_[number]); });
}

}  // namespace trc
