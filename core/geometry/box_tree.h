#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "core/base/numbered_queue.h"
#include "core/geometry/segment.h"

namespace trc {

using Box = Eigen::AlignedBox2d;

[[nodiscard]] Box bounding_box(const Segment& segment);

// 0 where they overlap or touch, mm^2.
[[nodiscard]] inline double squared_distance(const Box& a, const Box& b) {
  const double x = std::max({a.min().x() - b.max().x(), b.min().x() - a.max().x(), 0.0});
  const double y = std::max({a.min().y() - b.max().y(), b.min().y() - a.max().y(), 0.0});
  return x * x + y * y;
}

// Which of many boxes are near. The boxes keep their order, which is that of a
// path: neighbours on the path are neighbours in space, so that the tree needs no
// sorting, can grow at its end and be forgotten at its begin. A query costs
// O(log n + hits) on contours.
//
//     [    0 1 2 3     ] [    4 5 6 7     ]        Four boxes in a row have one about
//     [0] [1] [2] [3]    [4] [5] [6] [7]   [8]     them, four of those too, and so on,
//                                                  as soon as there are four.
class BoxTree {
 public:
  // Numbers from first to last; none if last < first.
  struct Range {
    std::size_t first = 1;
    std::size_t last = 0;
  };

  // The first box will have the number `first`.
  explicit BoxTree(std::size_t first = 0) { levels_.emplace_back(first); }

  void append(const Box& box);
  // Forgets the boxes from `number` on.
  void truncate(std::size_t number);
  // Forgets the boxes before `number`.
  void drop_before(std::size_t number);

  // A box; what is kept of it may be larger by the rounding of a float.
  [[nodiscard]] Box operator[](std::size_t number) const {
    return widened(levels_.front()[number]);
  }

  // Calls visit(number) for every box not farther than `reach` mm from `area`, in
  // ascending order, those in `skipped` left out.
  template <class Visit>
  void for_each_near(const Box& area, double reach, const Range& skipped, Visit visit) const {
    const NumberedQueue<Kept>& boxes = levels_.front();
    const auto is_near = [&](const Kept& box) {
      return squared_distance(widened(box), area) <= reach * reach;
    };
    if (skipped.last < skipped.first) {
      scan(is_near, boxes.begin(), boxes.end(), visit);
      return;
    }
    scan(is_near, boxes.begin(), std::min(skipped.first, boxes.end()), visit);
    scan(is_near, std::max(skipped.last + 1, boxes.begin()), boxes.end(), visit);
  }
  template <class Visit>
  void for_each_near(const Box& area, double reach, Visit visit) const {
    for_each_near(area, reach, Range{}, visit);
  }

 private:
  // There are many of them.
  using Kept = Eigen::AlignedBox2f;

  static Box widened(const Kept& box) {
    return {box.min().cast<double>(), box.max().cast<double>()};
  }

  static constexpr std::size_t bits_of_width = 2;
  static constexpr std::size_t width = 1 << bits_of_width;  // boxes under one

  [[nodiscard]] static std::size_t span(std::size_t level) {
    return std::size_t{1} << (bits_of_width * level);
  }

  // Goes through the largest boxes that cover nothing but first <= number < end, and into
  // those that are near.
  template <class IsNear, class Visit>
  void scan(const IsNear& is_near, std::size_t first, std::size_t end, Visit& visit) const {
    for (std::size_t number = first; number < end;) {
      // 0 is divisible by any power; no tree is that high.
      const auto zeros = static_cast<std::size_t>(std::min(std::countr_zero(number), 62));
      std::size_t level = std::min(levels_.size() - 1, zeros / bits_of_width);
      while (number + span(level) > end) --level;
      while (is_near(levels_[level][number / span(level)])) {
        if (level == 0) {
          visit(number);
          break;
        }
        --level;
      }
      number += span(level);
    }
  }

  std::vector<NumberedQueue<Kept>> levels_;  // 0: the boxes
};

}  // namespace trc
