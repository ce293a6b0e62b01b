#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"

namespace trc::plot {

// The contour blocks that compensation has put in place of programmed ones, by Source::index: the
// chord of an arc (CONV_CIR_TO_LIN), and the sides of a notch whose bottom was moved
// (KERF_MASKING). They are found from the path, which runs one tool radius beside them.
[[nodiscard]] std::map<std::uint64_t, Segment> changed_contour(
    std::span<const Block> programmed, std::span<const CompensatedBlock> path);

}  // namespace trc::plot
