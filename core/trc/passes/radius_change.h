#pragma once

#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Of an arc that changes the tool radius and whose path is more than half a turn: that ends where
// the programmed arc has turned by 180 degrees, and the rest of the block runs with the new radius
// around the programmed centre (rule 8, D-20). Returns what comes before the block, which has its
// tool path; null: nothing, the radius changes over all of it. Where the corner behind the block
// ends its path earlier, that is so however far the program goes on.
[[nodiscard]] PathBlockPtr take_first_half(PathBlock& block, const Tolerances& tolerances);

}  // namespace trc
