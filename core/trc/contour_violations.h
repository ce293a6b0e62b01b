#pragma once

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Finds contour violations: a compensated line that runs against the programmed
// one (90019), an arc that has been consumed and wraps round (90038). G140 stops
// there; with IGNORE_CONT_DAMAGE the path is put out as computed and the
// violation is a warning (D-12). Lengths up to the tolerance are none (D-13, D-14).
//
// Sees a block with its two neighbours, as the reference control does: a
// bottleneck between blocks further apart is not found.
class ContourViolations {
 public:
  ContourViolations(const Tolerances& tolerances, Diagnostics& diagnostics)
      : tolerances_(tolerances), diagnostics_(diagnostics) {}

  bool apply(PathBlock& block);

 private:
  bool check_line(const PathBlock& block);
  bool check_arc(const PathBlock& block, const Arc& programmed);
  bool check_range(const PathBlock& block);
  bool report_reversed(const PathBlock& block, double along);
  bool report_wrapped(const PathBlock& block, double left, double sweep);
  bool report_out_of_range(const PathBlock& block, Code code);
  bool report(Diagnostic violation, const PathBlock& block);

  Tolerances tolerances_;
  Diagnostics& diagnostics_;
};

}  // namespace trc
