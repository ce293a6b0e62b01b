#pragma once

#include <memory_resource>
#include <vector>

#include "core/trc/walls/closing.h"

namespace trc {

// mm
[[nodiscard]] double length_of_all(const ContourView& contour);

// Where the last blocks of a contour meet its first ones, from the outermost meeting inward: among
// the first five blocks, and all that begin within 10 · R of the start, and likewise at the end.
// With no more than half of the contour, which is `length` mm long, before and behind, or as little
// more as may belong to an overrun from there, or few blocks: short blocks meet all their
// neighbours too, which would be many.
[[nodiscard]] std::pmr::vector<EndsMeeting> meetings_of_ends(const ContourView& contour,
                                                             double closing_tolerance,
                                                             double tool_radius, double length,
                                                             std::pmr::memory_resource* memory);

}  // namespace trc
