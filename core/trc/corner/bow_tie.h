#pragma once

#include <algorithm>
#include <optional>

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"

namespace trc {

// Two blocks of a contour that cross beside a short one between them: a corner that rounding of
// coordinates has tied (D-44).
//
//            o                The short block leads from B to C. On the side where both corners
//            | .  C           are inside, the tool goes round the whole of it, which is an outside
//     -------x--.o            corner: round C, where B is less far beyond the block after it, else
//            |.'              round B.
//          B o
struct BowTie {
  double along_before = 0;  // mm, where they cross
  double along_after = 0;
  bool tip_at_end = false;  // round C
  bool turns_left = false;  // B and C are left turns
};

// The largest crossing, mm, that counts as a bow tie for a tool.
[[nodiscard]] inline double largest_bow_tie(double input_resolution, double tool_radius) {
  return std::min(input_resolution, 0.01 * tool_radius);
}

// A longer block is not the short one of a bow tie, mm.
[[nodiscard]] inline double longest_in_bow_tie(double largest) { return 16 * largest; }

// Nothing where they do not cross, or cross by more than `largest`.
[[nodiscard]] std::optional<BowTie> bow_tie_of(const Segment& before, const Segment& between,
                                               const Segment& after, double largest,
                                               const Tolerances& tolerances);

}  // namespace trc
