#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/trc/walls/closing.h"

namespace trc {

// A passage of the contour through a point.
struct Visit {
  ContourPlace place{};
  double way = 0;  // mm from the start of the contour
};

using Visits = std::pmr::vector<Visit>;

// All visits to the closing point; the two of the closing come first and last. O(n).
[[nodiscard]] Visits visits_of(const ContourView& contour, const Closing& closing, double tolerance,
                               std::pmr::memory_resource* memory);

// The longest way between two consecutive visits, mm; there are at least two visits.
[[nodiscard]] double longest_ring(std::span<const Visit> visits);

// A ring shorter than this share of the longest one leads from one lap to the next.
inline constexpr double share_of_lead_ring = 0.25;

// The number of rings without those.
[[nodiscard]] std::size_t laps_of(std::span<const Visit> visits);

}  // namespace trc
