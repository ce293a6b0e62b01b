#pragma once

#include <algorithm>
#include <vector>

#include "client/c/trc.h"
#include "core/base/diagnostic.h"
#include "core/geometry/plane.h"
#include "core/trc/result/compensated_block.h"

namespace trc::c {

inline void copy(const Position& position, double (&to)[3]) {
  std::copy(position.begin(), position.end(), to);
}

// One block or diagnostic as the structure that a caller reads, valid until the next one. It may
// point into what it was made of.
class AnswerOut {
 public:
  [[nodiscard]] const trc_motion* motion_of(const CompensatedBlock& block);
  [[nodiscard]] const trc_diagnostic* diagnostic_of(const Diagnostic& found);

 private:
  trc_motion motion_{};
  std::vector<double> axis_start_{};
  std::vector<double> axis_end_{};
  trc_diagnostic diagnostic_{};
  DiagnosticTexts texts_{};
  std::vector<trc_value> values_{};
};

}  // namespace trc::c
