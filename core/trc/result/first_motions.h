#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// The start of the first rapid motions is unknown: a program begins wherever the machine stands,
// and 0 is only an assumption. A picture that drew them would show a way, mostly right across the
// part, that is not travelled.
class FirstMotions {
 public:
  // Coordinates of the setup other than 0 count as known.
  explicit FirstMotions(const Position& start = Position{}) {
    for (std::size_t axis = 0; axis < said_.size(); ++axis) said_[axis] = start[axis] != 0;
  }

  // To be called in the order of the program: whether this is a rapid motion with unknown start.
  bool begins_unsaid(Plane plane, const Segment& path, const AxisTravel& normal, bool rapid) {
    if (all_said_) return false;
    const Position from = from_plane(plane, start_of(path), normal.from);
    const Position to = from_plane(plane, end_of(path), normal.to);
    bool unsaid = false;
    bool stays = true;
    for (std::size_t axis = 0; axis < said_.size(); ++axis) {
      const bool moves = from[axis] != to[axis];
      unsaid = unsaid || (rapid && moves && !said_[axis]);
      stays = stays && !moves;
    }
    for (std::size_t axis = 0; axis < said_.size(); ++axis) {
      // A motion without travel makes the position known.
      const bool in_plane = axis != axes_of(plane).third;
      said_[axis] = said_[axis] || !rapid || from[axis] != to[axis] || (stays && in_plane);
    }
    all_said_ = std::ranges::all_of(said_, [](bool said) { return said; });
    return unsaid;
  }

 private:
  std::array<bool, 3> said_{};
  bool all_said_ = false;
};

}  // namespace trc
