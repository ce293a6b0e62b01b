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
class UnknownStarts {
 public:
  // Coordinates of the setup other than 0 count as known.
  explicit UnknownStarts(const Position& start = Position{}) {
    for (std::size_t axis = 0; axis < known_.size(); ++axis) known_[axis] = start[axis] != 0;
  }

  // To be called in the order of the program: whether this is a rapid motion with unknown start.
  bool begins_at_unknown_place(Plane plane, const Segment& path, const AxisTravel& normal,
                               bool rapid) {
    if (all_known_) return false;
    const Position from = from_plane(plane, start_of(path), normal.from);
    const Position to = from_plane(plane, end_of(path), normal.to);
    bool is_unknown = false;
    bool stays = true;
    for (std::size_t axis = 0; axis < known_.size(); ++axis) {
      const bool moves = from[axis] != to[axis];
      is_unknown = is_unknown || (rapid && moves && !known_[axis]);
      stays = stays && !moves;
    }
    for (std::size_t axis = 0; axis < known_.size(); ++axis) {
      // A motion without travel makes the position known.
      const bool in_plane = axis != axes_of(plane).third;
      known_[axis] = known_[axis] || !rapid || from[axis] != to[axis] || (stays && in_plane);
    }
    all_known_ = std::ranges::all_of(known_, [](bool known) { return known; });
    return is_unknown;
  }

 private:
  std::array<bool, 3> known_{};
  bool all_known_ = false;
};

}  // namespace trc
