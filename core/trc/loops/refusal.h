#pragma once

#include <cstddef>

#include "core/base/diagnostic.h"
#include "core/base/tolerances.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"

namespace trc {

// Where the tool cannot go on under REMOVE_MASKED_BLOCKS.
struct DeadEnd {
  std::size_t block = 0;  // of the path
  Obstacles::Onset onset{};
  bool is_all_known = false;  // the contour, to its last point
};

// The reason for it. An end of the contour without room for the tool is named, with
// `largest_radius`, mm, of a tool that has room, to a micrometre.
[[nodiscard]] Diagnostic refusal_of(const HeldPath& path, const Obstacles& obstacles,
                                    const DeadEnd& dead_end, const Tolerances& tolerances);

}  // namespace trc
