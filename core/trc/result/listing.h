#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/trc/result/compensated_block.h"

namespace trc {

[[nodiscard]] std::string_view name_of(Origin origin);

// Appends the text form of a block, one line without line end:
//
//   40 approach line 0.0000 0.0000 0.0000 -> 30.0000 30.0000 0.0000 F1000
//   50 transition arc 30.0000 … -> … center 30.0000 20.0000 0.0000 sweep -90.0000 F1000
//   55 passthrough M8
//   60 programmed rapid 30.0000 … -> 60.0000 …
//
// The N word ("-" when there is none), the origin, the shape, start and end as
// X Y Z in mm. `center` is at the height of the start; `sweep` in degrees,
// positive counter-clockwise. A tracking axis that moves follows with its name
// ("A 0.0000 -> 10.0000"; "#1" when `tracking_axes` does not name it), a feed in
// mm/min when there is one. 0 <= decimals <= 9.
void append_listing(std::string& out, const CompensatedBlock& block,
                    std::span<const std::string> tracking_axes = {}, int decimals = 4);

}  // namespace trc
