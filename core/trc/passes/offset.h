#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Whether an equidistant with this radius is too small to travel on (90017).
[[nodiscard]] inline bool vanishes(double radius, const Tolerances& tolerances) {
  return radius < tolerances.on_contour;
}

// The criterion where loops are removed: an equidistant exists however small it is, and may be the
// only way on.
[[nodiscard]] inline bool is_unreachable(double radius, double shift,
                                         const Tolerances& tolerances) {
  return radius <= tolerances.rounding * std::max(std::abs(shift), 1.0);
}

// Sets tangents, P and Q of the block, even where its circle vanishes.
void give_offsets(PathBlock& block);

// Finds the equidistant of each programmed block: its tangents and the
// perpendicular points Q and P at its ends.
//
//   P ----------- Q      at the distance of the tool radius,
//   |             |      to the side of the tool
//   o=============o
//
// Stops at an arc the tool does not fit into (90017); under G141 it is masked.
class Offset {
 public:
  Offset(const Tolerances& tolerances, Diagnostics& diagnostics)
      : tolerances_(tolerances), diagnostics_(diagnostics) {}

  bool apply(PathBlock& block);

 private:
  bool keeps_circle(PathBlock& block, double shift);
  bool report_not_smaller(const PathBlock& block, const Arc& arc, double shift);

  Tolerances tolerances_;
  Diagnostics& diagnostics_;
};

}  // namespace trc
