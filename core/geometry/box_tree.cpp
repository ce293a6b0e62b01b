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

BoxTree::BoxTree(const std::vector<Box>& boxes) : count_(boxes.size()) {
  levels_.push_back(boxes);
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + width - 1) / width);
    for (std::size_t i = 0; i < below.size(); ++i) above[i / width].extend(below[i]);
    levels_.push_back(std::move(above));
  }
}

}  // namespace trc
