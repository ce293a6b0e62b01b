#pragma once

#include <array>
#include <cstdint>

#include "core/trc/result/compensated_block.h"

namespace trc {

// The figures of a finished session.
struct Summary {
  std::uint64_t blocks_in = 0;  // relevant and passive blocks
  std::uint64_t blocks_out = 0;
  std::array<std::uint64_t, origin_count> blocks_by_origin{};
  double programmed_length = 0;   // mm, in the plane
  double compensated_length = 0;  // mm, in the plane
};

}  // namespace trc
