#include "core/geometry/box_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace trc {

Box bounding_box(const Arc& arc) {
  Box box = bounding_box(arc.start, arc.end);
  // Counter-clockwise from `first` to `last`.
  Vector first = arc.start - arc.center;
  Vector last = arc.end - arc.center;
  if (arc.sweep < 0) std::swap(first, last);
  const bool more_than_half = std::abs(arc.sweep) > std::numbers::pi;
  const double radius = first.norm();
  for (const Vector& axis : {Vector(1, 0), Vector(0, 1), Vector(-1, 0), Vector(0, -1)}) {
    const bool behind_first = cross(first, axis) >= 0;
    const bool before_last = cross(axis, last) >= 0;
    const bool passed = more_than_half ? behind_first || before_last : behind_first && before_last;
    if (passed) box.extend(arc.center + radius * axis);
  }
  return box;
}

void BoxTree::append(const Box& box) {
  if (levels_.front().add(kept(box))) add_above();
}

[[gnu::noinline]] void BoxTree::add_above() {
  for (std::size_t level = 0;; ++level) {
    const KeptBox next = levels_[level].fours.back().about_all();
    if (level + 1 == levels_.size())
      levels_.emplace_back(levels_[level].end / FourBoxes::count - 1);
    if (!levels_[level + 1].add(next)) return;
  }
}

void BoxTree::truncate(std::size_t number) {
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    auto& [fours, end] = levels_[level];
    end = number >> span_bits(level);
    fours.truncate((end + FourBoxes::count - 1) / FourBoxes::count);
    if (!fours.empty() && end % FourBoxes::count != 0)
      fours.back().clear_from(end % FourBoxes::count);
  }
}

void BoxTree::clear(std::size_t first) {
  begin_ = first;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    levels_[level].end = first >> span_bits(level);
    levels_[level].fours.clear(levels_[level].end / FourBoxes::count);
  }
}

void BoxTree::drop_before(std::size_t number) {
  // Only now and then: each level costs time.
  constexpr std::size_t worthwhile = 64;
  const bool due = number / worthwhile > begin_ / worthwhile;
  begin_ = number;
  if (!due) return;
  for (std::size_t level = 0; level < levels_.size(); ++level)
    levels_[level].fours.drop_before((number >> span_bits(level)) / FourBoxes::count);
}

}  // namespace trc
