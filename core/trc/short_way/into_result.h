#pragma once

#include <vector>

#include "core/base/tolerances.h"
#include "core/nc/state/block.h"
#include "core/trc/corner/corner.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/short_way/at_corner.h"

namespace trc {

// The end of the short way where no loops are removed: Reporting.
class IntoResult {
 public:
  IntoResult(const Tolerances& tolerances, Reporting& reporting)
      : tolerances_(tolerances), reporting_(reporting) {}

  // Puts out the block before the corner and the blocks inserted after it. Returns false, without
  // doing anything, for blocks left to the passes: contour violations, or values out of range.
  bool put_out(const AtCorner& at, const Joint& joint, std::vector<CompensatedBlock>& out);

 private:
  template <class Path>
  bool put_out(const Path& path, const AtCorner& at, const Joint& joint,
               std::vector<CompensatedBlock>& out);

  Tolerances tolerances_;
  Reporting& reporting_;
  MotionBlock inserted_{};  // one after the other
};

}  // namespace trc
