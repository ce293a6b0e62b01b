#pragma once

#include <cstddef>

#include "core/base/diagnostic.h"
#include "core/base/tolerances.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"

namespace trc {

// Why REMOVE_MASKED_BLOCKS takes the tool no further than to an onset in a block of the path. An
// end of the contour at which the tool has no room is named, with `largest_radius`, mm: of the tool
// that has, to a micrometre. `ended`: the last point of the contour is known.
[[nodiscard]] Diagnostic refusal_of(const HeldPath& path, const Obstacles& obstacles,
                                    std::size_t block, const Obstacles::Onset& onset, bool ended,
                                    const Tolerances& tolerances);

}  // namespace trc
