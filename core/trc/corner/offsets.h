#pragma once

#include <algorithm>
#include <cmath>

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

// The data that a corner needs of a block, but for what give_offsets() sets.
[[nodiscard]] PathBlock outline_of(const PathBlock& block);

// Sets tangents, P and Q of the block, even where its circle vanishes.
void give_offsets(PathBlock& block);

}  // namespace trc
