#include "core/nc/state/held_corner.h"

#include <utility>

namespace trc {

void HeldCorner::put_in(const CutCorner& corner, double same_point) {
  MotionBlock& motion = before();
  if (length_of(corner.before) <= same_point) {
    motion.path = corner.between;
    if (feed_ != 0) motion.feed = feed_;
    return;
  }
  motion.path = corner.before;
  if (length_of(corner.after) <= same_point) return;
  MotionBlock between = motion;
  between.path = corner.between;
  ++between.source.part;
  if (feed_ != 0) between.feed = feed_;
  auto place = blocks_.begin() + 1;
  if (source_) {
    between.source = *source_;
    while (place != blocks_.end() && index_of(*place) <= between.source.index) ++place;
  }
  blocks_.insert(place, std::move(between));
}

void HeldCorner::release(std::vector<Block>& to) {
  // Nearly always one block.
  for (Block& block : blocks_) to.push_back(std::move(block));
  blocks_.clear();
  cut_.reset();
  source_.reset();
  feed_ = 0;
}

}  // namespace trc
