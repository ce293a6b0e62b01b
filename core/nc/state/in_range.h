#pragma once

namespace trc {

// False for NaN, too.
[[nodiscard]] inline bool in_range(double value, double smallest, double largest) {
  return value >= smallest && value <= largest;
}

}  // namespace trc
