#pragma once

#include <cmath>

#include "core/trc/walls/closing.h"

namespace trc {

// Of stretches of a contour.
struct Extent {
  double length = 0;  // mm
  // What a line from the start of the contour to a point on them sweeps over, mm²; positive where
  // it turns to the left.
  double area = 0;
};

// O(n).
[[nodiscard]] Extent extent_of(const ContourView& contour);

// The ring between two places that coincide, where `all` is the extent of the contour. O(number of
// blocks outside the ring).
[[nodiscard]] Extent extent_of_ring(const ContourView& contour, const Extent& all,
                                    const ContourPlace& begin, const ContourPlace& end);

// Whether a ring encloses as little as straight leads may on either side of them.
[[nodiscard]] inline bool is_slender(const Extent& ring) {
  return std::abs(ring.area) <= 0.01 * ring.length * ring.length;
}

}  // namespace trc
