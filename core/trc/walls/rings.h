#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "core/trc/walls/closing.h"

namespace trc {

// The contour comes by a point.
struct Visit {
  ContourPlace place{};
  double way = 0;  // mm from the start of the contour
};

using Visits = std::pmr::vector<Visit>;

// Every time the contour comes by the closing point, the two of the closing first and last. O(n).
[[nodiscard]] Visits visits_of(const ContourView& contour, const Closing& closing, double tolerance,
                               std::pmr::memory_resource* memory);

// mm, between two visits; there are at least two.
[[nodiscard]] double longest_ring(std::span<const Visit> visits);

}  // namespace trc
