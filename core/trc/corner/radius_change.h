#pragma once

#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// For an arc that changes the tool radius and whose path is more than half a turn: the change ends
// where the programmed arc has turned by 180 degrees, and the rest of the block runs with the new
// radius around the programmed centre (rule 8, D-20). Returns the part that comes before the block,
// with its tool path; null: there is none, the radius changes over the whole block. The corner
// after the block may end its path earlier; the change still ends there.
[[nodiscard]] PathBlockPtr take_first_half(PathBlock& block, const Tolerances& tolerances);

}  // namespace trc
