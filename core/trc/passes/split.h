#pragma once

#include <vector>

#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// `#TRC [SPLIT …]`: the parts of the approach and the retract line next to the
// contour get feeds of their own (rule 7.2, D-19).
//
//   S ------ rest ------ | 1 | 2 |= contour =| 2 | 1 | ---- rest ---- T
//
// A part that is longer than the line is not split off; of two parts that do not both fit, only the
// second is. A part as long as the line, within 0.1 um (D-14), is all of it.
class Split {
 public:
  explicit Split(const Tolerances& tolerances) : tolerances_(tolerances) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const { return !block.splittable; }
  bool drain(PathBlocks& /*out*/) { return true; }

 private:
  Tolerances tolerances_;
};

}  // namespace trc
