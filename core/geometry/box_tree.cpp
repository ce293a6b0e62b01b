#include "core/geometry/box_tree.h"

#include <algorithm>

#include "core/geometry/distance.h"

namespace trc {

Box bounding_box(const Segment& segment) {
  Box box(start_of(segment));
  box.extend(end_of(segment));
  if (const auto* arc = std::get_if<Arc>(&segment)) {
    const double radius = radius_of(*arc);
    for (const Vector& axis : {Vector(1, 0), Vector(0, 1), Vector(-1, 0), Vector(0, -1)}) {
      const Point extreme = arc->center + radius * axis;
      if (covers(*arc, extreme)) box.extend(extreme);
    }
  }
  return box;
}

void BoxTree::append(const Box& box) {
  std::size_t node = size();
  for (std::size_t level = 0;; ++level, node /= width) {
    if (level == levels_.size()) {
      // The root has got a neighbour, or there was none yet.
      levels_.emplace_back();
      if (level > 0) levels_[level].push_back(levels_[level - 1].front());
    }
    std::vector<Box>& boxes = levels_[level];
    if (node == boxes.size()) {
      boxes.push_back(box);
    } else {
      boxes[node].extend(box);
    }
    if (level + 1 == levels_.size() && boxes.size() == 1) return;
  }
}

void BoxTree::truncate(std::size_t count) {
  if (count == 0) levels_.clear();
  for (std::vector<Box>& boxes : levels_) {
    boxes.resize(count);
    count = (count + width - 1) / width;
  }
}

void BoxTree::drop_before(std::size_t first) {
  const std::vector<Box> boxes = levels_.empty() ? std::vector<Box>{} : std::move(levels_[0]);
  levels_.clear();
  for (std::size_t index = first; index < boxes.size(); ++index) append(boxes[index]);
}

}  // namespace trc
