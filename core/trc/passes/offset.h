#pragma once

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Finds the equidistant of each programmed block: its tangents and the
// perpendicular points Q and P at its ends.
//
//   P ----------- Q      at the distance of the tool radius,
//   |             |      to the side of the tool
//   o=============o
//
// Stops at an arc the tool does not fit into (90017); under G141 it is masked.
class Offset {
 public:
  Offset(const Tolerances& tolerances, Diagnostics& diagnostics)
      : tolerances_(tolerances), diagnostics_(diagnostics) {}

  bool apply(PathBlock& block);

 private:
  bool keeps_circle(PathBlock& block, double shift);
  bool report_not_smaller(const PathBlock& block, const Arc& arc, double shift);

  Tolerances tolerances_;
  Diagnostics& diagnostics_;
};

}  // namespace trc
