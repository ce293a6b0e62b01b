#pragma once

#include <vector>

#include "core/trc/walls/closing.h"

namespace trc {

// The contour comes by a point.
struct Visit {
  ContourPlace place{};
  double way = 0;  // mm from the start of the contour
};

// Every time the contour comes by the closing point, the two of the closing first and last. O(n).
[[nodiscard]] std::vector<Visit> visits_of(const ContourView& contour, const Closing& closing,
                                           double tolerance);

// mm, between two visits; there are at least two.
[[nodiscard]] double longest_ring(const std::vector<Visit>& visits);

}  // namespace trc
