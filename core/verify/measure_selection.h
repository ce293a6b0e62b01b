#pragma once

#include <cstddef>

#include "core/base/checkpoint.h"
#include "core/verify/clearance.h"
#include "core/verify/measured_path.h"
#include "core/verify/selection_walls.h"

namespace trc::verify {

// The programmed pieces of one selection, from `begin` to `end`, and their walls.
struct SelectionPieces {
  const MeasuredPath& held;
  std::size_t begin;
  std::size_t end;
  const SelectionWalls& walls;
};

// Measures the pieces of the path from `next` on that stem from this selection, and moves that to
// the one after them.
[[nodiscard]] ClearanceReport measure_selection(const SelectionPieces& selection, std::size_t& next,
                                                const ClearanceSettings& settings,
                                                Checkpoint& checkpoint);

}  // namespace trc::verify
