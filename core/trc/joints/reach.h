#pragma once

#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Whether a tool of this radius, mm, leaves a contour block a compensated length between the blocks
// before and after it, which end and begin where it begins and ends.
[[nodiscard]] bool is_reached(const PathBlock& before, const PathBlock& block,
                              const PathBlock& after, double radius, const Tolerances& tolerances);

// The largest such radius up to that of the tool, to a micrometre; 0: none.
[[nodiscard]] double largest_radius_for(const PathBlock& before, const PathBlock& block,
                                        const PathBlock& after, const Tolerances& tolerances);

// The width, mm, of the slot between the blocks before and after a block, where these are lines in
// opposite directions; 0: they are not.
[[nodiscard]] double slot_width(const Segment& before, const Segment& after);

}  // namespace trc
