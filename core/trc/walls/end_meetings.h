#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

#include "core/trc/walls/closing.h"

namespace trc {

// A contour closes near its ends: on one of so many blocks, or within so many tool radii of them.
constexpr std::size_t blocks_at_ends = 5;
constexpr double reach_of_ends = 10;

// The places where the last blocks of a contour meet its first ones, from the outermost inward:
// among the first five blocks and all that begin within 10 · R of the start, and the corresponding
// blocks at the end. At most half of the contour, which is `length` mm long, may lie before and
// after a meeting, or the little more that an overrun from there may add, or few blocks: short
// blocks also meet all their neighbours, which would be many.
[[nodiscard]] std::pmr::vector<EndsMeeting> meetings_of_ends(const ContourView& contour,
                                                             double closing_tolerance,
                                                             double tool_radius, double length,
                                                             std::pmr::memory_resource* memory);

}  // namespace trc
