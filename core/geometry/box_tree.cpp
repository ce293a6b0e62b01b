#include "core/geometry/box_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace trc {
namespace {

using TwoDoubles = __attribute__((vector_size(16))) double;
using TwoFloats = __attribute__((vector_size(8))) float;
using Floats = __attribute__((vector_size(16))) float;
using Truths = __attribute__((vector_size(16))) std::int32_t;

// rounded_down(), of four values together.
Floats all_rounded_down(const TwoDoubles& first, const TwoDoubles& second) {
  constexpr float least = std::numeric_limits<float>::min();
  constexpr float epsilon = std::numeric_limits<float>::epsilon();
  constexpr std::int32_t all_but_sign = std::numeric_limits<std::int32_t>::max();
  const auto first_floats = __builtin_convertvector(first, TwoFloats);
  const auto second_floats = __builtin_convertvector(second, TwoFloats);
  const Floats nearest = __builtin_shufflevector(first_floats, second_floats, 0, 1, 2, 3);
  const auto first_above = __builtin_convertvector(first_floats, TwoDoubles) > first;
  const auto second_above = __builtin_convertvector(second_floats, TwoDoubles) > second;
  const Truths above = __builtin_shufflevector(std::bit_cast<Truths>(first_above),
                                               std::bit_cast<Truths>(second_above), 0, 2, 4, 6);
  const auto size = std::bit_cast<Floats>(std::bit_cast<Truths>(nearest) & all_but_sign);
  const Floats unit = size * epsilon + least;
  return nearest - std::bit_cast<Floats>(std::bit_cast<Truths>(unit) & above);
}

// kept(), all sides together.
KeptBox kept_at_once(const Box& box) {
  const TwoDoubles lower{box.min().x(), box.min().y()};
  const TwoDoubles upper{box.max().x(), box.max().y()};
  const Floats sides = all_rounded_down(lower, -upper);
  return {Eigen::Vector2f(sides[0], sides[1]), Eigen::Vector2f(-sides[2], -sides[3])};
}

}  // namespace

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
  if (levels_.front().add(kept_at_once(box))) add_above();
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

void BoxTree::drop_before(std::size_t number) {
  // Now and then, as each level costs something.
  constexpr std::size_t worthwhile = 64;
  const bool due = number / worthwhile > begin_ / worthwhile;
  begin_ = number;
  if (!due) return;
  for (std::size_t level = 0; level < levels_.size(); ++level)
    levels_[level].fours.drop_before((number >> span_bits(level)) / FourBoxes::count);
}

}  // namespace trc
