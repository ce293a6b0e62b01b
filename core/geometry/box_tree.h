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
// sorting. Built in O(n); a query costs O(log n + hits) on contours.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  // Calls visit(index) for every box that meets `area`, in ascending order.
  template <class Visit>
  void for_each_in(const Box& area, Visit visit) const {
    if (count_ > 0) descend(levels_.size() - 1, 0, area, visit);
  }

 private:
  static constexpr std::size_t width = 4;  // children of a node

  template <class Visit>
  void descend(std::size_t level, std::size_t node, const Box& area, Visit& visit) const {
    if (!levels_[level][node].intersects(area)) return;
    if (level == 0) {
      visit(node);
      return;
    }
    const std::size_t end = std::min((node + 1) * width, levels_[level - 1].size());
    for (std::size_t child = node * width; child < end; ++child)
      descend(level - 1, child, area, visit);
  }

  std::size_t count_;
  std::vector<std::vector<Box>> levels_;  // 0: the boxes, last: one root
};

}  // namespace trc
