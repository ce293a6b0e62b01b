#pragma once

#include <cstddef>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/nc/state/trc_mode.h"
#include "core/trc/result/compensated_block.h"
#include "tests/support/contours.h"

namespace trc::support {

// Tool radius compensation of one selection, computed slowly and from the rule
// book alone: extended precision, and inside corners by walking along the second
// equidistant until it has left the first one's strip. The judge of the core;
// shares no geometry with it.
//
// Knows G138, G139 and G239, G25 and G26, STRETCH_FACTOR, and the violations
// 90017, 90019 and 90038 of G140. No other option, no side or radius change.
struct SlowPoint {
  long double x = 0;
  long double y = 0;
};

struct SlowBlock {
  bool is_arc = false;
  SlowPoint start{};
  SlowPoint end{};
  SlowPoint center{};
  long double sweep = 0;  // rad
  Origin origin = Origin::programmed;
  // 0 is the approach block, 1 … n the contour, n + 1 the retract block. An
  // inserted block has the ordinal of the block it follows.
  std::size_t ordinal = 0;
};

struct SlowFault {
  Code code{};
  std::size_t ordinal = 0;
};

struct SlowOutcome {
  // The path in order, complete when there is no fault, else as far as it is
  // certain. Blocks without length are in it.
  std::vector<SlowBlock> path{};
  // Every violation in path order. Where two equidistants do not meet at all,
  // both neighbours are named: either may be reported.
  std::vector<SlowFault> faults{};
  // Somewhere the decision hangs on less than the tolerances: another answer
  // would be right, too.
  bool borderline = false;
};

[[nodiscard]] SlowOutcome slow_trc(const Contour& contour, const TrcMode& mode);

}  // namespace trc::support
