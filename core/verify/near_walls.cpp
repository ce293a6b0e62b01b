#include "core/verify/near_walls.h"

#include "core/verify/capsule.h"

namespace trc::verify {

void NearWalls::find(std::size_t first, std::size_t behind, double reach) {
  near_.clear();
  is_known_ = true;
  first_ = first;
  behind_ = behind;
  const Box box = box_of_group();
  // The box of a group in windings is near to all of them, and so is that of the next group.
  if (!winds_) {
    exist_ = tree_.find_near(box, reach, leaves_);
    winds_ = !exist_;
  }
  if (winds_) {
    tree_.make_rings(checkpoint_);
    exist_ = tree_.find_near(box, ring_of_group(), reach, leaves_);
    winds_ = exist_;
  }
  if (!exist_) return tree_.make_own_rings(checkpoint_);
  tree_.gather(leaves_, origin_, winds_, near_);
}

Box NearWalls::box_of_group() {
  const auto& path = held_.path();
  const Vector way = path[behind_ - 1].piece.end - path[first_].piece.start;
  const double length = magnitude(way);
  BoxAlong around(length > 0 ? Vector(way / length) : Vector::UnitX());
  origin_ = path[first_].piece.start;
  auto pieces = path.from(first_);
  const std::size_t count = behind_ - first_;
  for (std::size_t number = 0; number < count; ++number) {
    const Capsule capsule = capsule_of(pieces.next().piece);
    add_to(around, capsule);
    FourWalls& four = pieces_[number / FourWalls::count];
    const std::size_t place = number % FourWalls::count;
    if (place == 0) four = {};
    four.set(place, capsule, origin_);
    if (place + 1 == FourWalls::count || number + 1 == count) four.finish();
  }
  return around.box();
}

Ring NearWalls::ring_of_group() {
  auto pieces = held_.path().from(first_);
  Ring ring;
  for (std::size_t place = 0; place < behind_ - first_; ++place) {
    rings_[place] = tree_.about_middle(pieces.next().piece);
    ring = ring.exists() ? verify::around(ring, rings_[place]) : rings_[place];
  }
  return ring;
}

}  // namespace trc::verify
