#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "core/geometry/segment.h"

namespace trc {

using Box = Eigen::AlignedBox2d;

[[nodiscard]] Box bounding_box(const Segment& segment);

// Which of many boxes are near. The boxes keep their order, which is that of a
// path: neighbours on the path are neighbours in space, so that the tree needs no
// sorting and can grow at its end. A query costs O(log n + hits) on contours.
class BoxTree {
 public:
  // Indices from first to last; none if last < first.
  struct Range {
    std::size_t first = 1;
    std::size_t last = 0;
  };

  void append(const Box& box);
  [[nodiscard]] std::size_t size() const { return levels_.empty() ? 0 : levels_[0].size(); }
  // Forgets all but the first `count` boxes. What they were in stays as large.
  void truncate(std::size_t count);
  // The boxes from `first` on, counted anew.
  void drop_before(std::size_t first);

  // Calls visit(index) for every box that meets `area`, in ascending order, those
  // in `skipped` left out.
  template <class Visit>
  void for_each_in(const Box& area, const Range& skipped, Visit visit) const {
    if (size() > 0) descend(levels_.size() - 1, 0, area, skipped, visit);
  }
  template <class Visit>
  void for_each_in(const Box& area, Visit visit) const {
    for_each_in(area, Range{}, visit);
  }

 private:
  static constexpr std::size_t bits_of_width = 2;
  static constexpr std::size_t width = 1 << bits_of_width;  // children of a node

  template <class Visit>
  void descend(std::size_t level, std::size_t node, const Box& area, const Range& skipped,
               Visit& visit) const {
    const std::size_t span = std::size_t{1} << (bits_of_width * level);
    if (node * span >= skipped.first && (node + 1) * span - 1 <= skipped.last) return;
    if (!levels_[level][node].intersects(area)) return;
    if (level == 0) {
      visit(node);
      return;
    }
    const std::size_t end = std::min((node + 1) * width, levels_[level - 1].size());
    for (std::size_t child = node * width; child < end; ++child)
      descend(level - 1, child, area, skipped, visit);
  }

  std::vector<std::vector<Box>> levels_;  // 0: the boxes, last: one root
};

}  // namespace trc
