#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/nc/state/block.h"
#include "core/trc/walls/sided_walls.h"

namespace trc {

// The contour of one selection as it was programmed.
struct SelectionContour {
  std::vector<const MotionBlock*> blocks{};
  std::vector<std::size_t> changes{};  // of side: the first block after each
};

// The contours of a program, in order. A block that leads to a contour, or changes its side, is not
// part of it.
[[nodiscard]] std::vector<SelectionContour> contours_of(std::span<const Block> programmed);

[[nodiscard]] SidedWalls find_walls(const SelectionContour& contour, const LeadSettings& settings);

}  // namespace trc
