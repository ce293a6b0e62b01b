#pragma once

#include <cstddef>
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

// A ring shorter than this share of the longest one leads from one lap to the next.
inline constexpr double share_of_lead_ring = 0.25;

// How many rings there are but for those.
[[nodiscard]] std::size_t laps_of(std::span<const Visit> visits);

}  // namespace trc
