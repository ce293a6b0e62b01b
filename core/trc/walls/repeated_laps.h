#pragma once

#include <cstddef>
#include <optional>

#include "core/trc/walls/closing.h"

namespace trc {

// A contour whose blocks repeat: the same lap with the same leads at several depths (D-107).
struct RepeatedLaps {
  std::size_t blocks = 0;  // from the start of one lap, with its leads, to that of the next one
  std::size_t last = 0;    // the first block of the last one
};

// Nothing: they do not repeat from end to end. The last lap may lack the leads to a next one.
[[nodiscard]] std::optional<RepeatedLaps> repeated_laps(const ContourView& contour);

}  // namespace trc
