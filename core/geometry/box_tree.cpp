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
  levels_.front().push_back(box);
  const std::size_t end = levels_.front().end();
  for (std::size_t level = 1; end % span(level) == 0; ++level) {
    const NumberedQueue<Box>& below = levels_[level - 1];
    const std::size_t number = end / span(level) - 1;
    // Boxes that have been forgotten are not asked for any more.
    Box about = below.back();
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
