#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/tolerances.h"

namespace trc {

// Which blocks of a contour are leads: no walls, as they bound no material (D-38).
struct LeadSettings {
  enum class Find : std::uint8_t {
    automatic,  // what lies before and after the closing of the contour
    none,       // no block, unless it is marked
    counted,    // so many at the start and at the end
  };
  Find find = Find::automatic;
  std::size_t blocks_in = 0;  // of `counted`
  std::size_t blocks_out = 0;
  double closing_tolerance = 0.01;  // mm
  // The part beyond the crossing of a bow tie smaller than this is no wall, mm (D-44).
  double input_resolution = Tolerances{}.input_resolution;
};

}  // namespace trc
