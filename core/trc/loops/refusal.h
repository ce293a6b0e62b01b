#pragma once

#include <cstddef>

#include "core/base/diagnostic.h"
#include "core/base/tolerances.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"

namespace trc {

// Where REMOVE_MASKED_BLOCKS takes the tool no further.
struct DeadEnd {
  std::size_t block = 0;  // of the path
  Obstacles::Onset onset{};
  bool is_all_known = false;  // the contour, to its last point
};

// Why it does not. An end of the contour at which the tool has no room is named, with
// `largest_radius`, mm: of the tool that has, to a micrometre.
[[nodiscard]] Diagnostic refusal_of(const HeldPath& path, const Obstacles& obstacles,
                                    const DeadEnd& dead_end, const Tolerances& tolerances);

}  // namespace trc
