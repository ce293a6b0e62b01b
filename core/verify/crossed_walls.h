#pragma once

#include <cstddef>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/verify/clearance.h"
#include "core/verify/measure_selection.h"

namespace trc::verify {

// The walls that an approach or a retract of the selection leads through, one of each way, in the
// order of the program (D-166). A way that begins or ends on a wall leads through none there, and
// one above the path leads over the part. Nor is one told at the walls with which an open contour
// begins and ends: it may reach beyond the part there. `first` and `behind`: the pieces of the path
// that stem from the selection.
[[nodiscard]] std::vector<CrossedWall> crossed_walls(const SelectionPieces& selection,
                                                     std::size_t first, std::size_t behind,
                                                     const ClearanceSettings& settings,
                                                     Checkpoint& checkpoint);

}  // namespace trc::verify
