#pragma once

#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// CONV_CIR_TO_LIN: under G141 an arc that shrinks under the offset and is not
// larger than the tool becomes its chord (rule 7, D-17, D-18). Full circles have
// none and are left to contour masking.
class ConvertCircles {
 public:
  explicit ConvertCircles(const Tolerances& tolerances) : tolerances_(tolerances) {}

  bool apply(PathBlock& block) const;

 private:
  Tolerances tolerances_;
};

}  // namespace trc
