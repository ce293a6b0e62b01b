#pragma once

#include <cstddef>
#include <limits>

#include "core/nc/text/number_format.h"

namespace trc {

// What a control takes in one line (D-180). Where no limit is known there is none.
struct LineLimits {
  static constexpr int any_number = std::numeric_limits<int>::max();

  std::size_t characters = std::numeric_limits<std::size_t>::max();  // without the line end
  int digits = any_number;           // of a number, on both sides of its point
  int decimals = most_decimals - 1;  // of a coordinate in mm; one more in inch
};

}  // namespace trc
