#include "core/geometry/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace trc {
namespace {

// By at most two units in the last place too far.
float rounded_down(double value) {
  constexpr float least = std::numeric_limits<float>::min();
  const auto nearest = static_cast<float>(value);
  const float unit = std::abs(nearest) * std::numeric_limits<float>::epsilon() + least;
  return static_cast<double>(nearest) <= value ? nearest : nearest - unit;
}

}  // namespace

Box bounding_box(const Segment& segment) {
  Box box(start_of(segment));
  box.extend(end_of(segment));
  const auto* arc = std::get_if<Arc>(&segment);
  if (arc == nullptr) return box;
  // Counter-clockwise from `first` to `last`.
  Vector first = arc->start - arc->center;
  Vector last = arc->end - arc->center;
  if (arc->sweep < 0) std::swap(first, last);
  const bool more_than_half = std::abs(arc->sweep) > std::numbers::pi;
  const double radius = first.norm();
  for (const Vector& axis : {Vector(1, 0), Vector(0, 1), Vector(-1, 0), Vector(0, -1)}) {
    const bool behind_first = cross(first, axis) >= 0;
    const bool before_last = cross(axis, last) >= 0;
    const bool passed = more_than_half ? behind_first || before_last : behind_first && before_last;
    if (passed) box.extend(arc->center + radius * axis);
  }
  return box;
}

void BoxTree::append(const Box& box) {
  levels_.front().push_back(
      {Eigen::Vector2f(rounded_down(box.min().x()), rounded_down(box.min().y())),
       Eigen::Vector2f(-rounded_down(-box.max().x()), -rounded_down(-box.max().y()))});
  const std::size_t end = levels_.front().end();
  for (std::size_t level = 1; end % span(level) == 0; ++level) {
    const NumberedQueue<Kept>& below = levels_[level - 1];
    const std::size_t number = end / span(level) - 1;
    // Boxes that have been forgotten are not asked for any more.
    Kept about = below.back();
    for (std::size_t child = std::max(number * width, below.begin()); child < below.end(); ++child)
      about.extend(below[child]);
    if (level == levels_.size()) levels_.emplace_back(number);
    levels_[level].push_back(about);
  }
}

void BoxTree::truncate(std::size_t number) {
  for (std::size_t level = 0; level < levels_.size(); ++level)
    levels_[level].truncate(number / span(level));
}

void BoxTree::drop_before(std::size_t number) {
  for (std::size_t level = 0; level < levels_.size(); ++level)
    levels_[level].drop_before(std::min(number / span(level), levels_[level].end()));
}

}  // namespace trc
