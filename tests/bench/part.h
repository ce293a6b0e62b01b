#pragma once

#include <string>
#include <vector>

#include "core/nc/state/block.h"

namespace trc::bench {

// The contour the speed of the whole way is told by: lines and arcs, one block in three an arc,
// small turns to both sides, G42 with R5, G139, G26, G140 (`trc generate --shape random`). It is
// closed, and travelled lap after lap, so that a stage can be fed for as long as one likes.
struct Part {
  static constexpr std::size_t blocks_per_lap = 1000;

  std::string prologue{};         // NC text up to the approach
  std::string lap{};              // a line a block
  std::vector<Block> approach{};  // what reading them gives
  std::vector<Block> lap_blocks{};
};

[[nodiscard]] const Part& part();

}  // namespace trc::bench
