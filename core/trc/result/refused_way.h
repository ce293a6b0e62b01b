#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// The facts that the pass refusing a selection or deselection block knows, for finding a way in its
// place.
struct RefusedWay {
  bool leaves = false;
  // A way in: the selection block and the contour after it as far as it is known. A way out: the
  // last contour block and the deselection block. None: nothing was refused.
  std::vector<MotionBlock> blocks{};
  double shift = 0;  // mm to the left of the contour; negative: right
  // The length that the block needs under G236, mm along itself, and that a line in its last
  // (first) direction would need; none: no length is enough, or the length is not at fault.
  std::optional<double> needed_length{};
  std::optional<double> needed_straight{};
  // The cut of the corner before it from the last contour block, as in PathBlock.
  double cut_at_start = 0;
  // Where loops are removed, `blocks` begins after the leads at the start: the numbers of leads
  // left out there, and of blocks at its end that are no walls.
  bool removes_loops = false;
  bool at_begin = false;  // nothing of it can be travelled
  std::size_t leads_in = 0;
  std::size_t leads_out = 0;
  // The way in is not at fault: `blocks` are a whole contour that begins and closes in an inside
  // corner, where the tool has no room beside the start (rule 3.2).
  bool in_corner = false;
  // Where the way in meets the equidistant under G238, which needs no length but a free start.
  std::optional<Point> target{};
  // Under G238 too: the start has to lie on the tool side of the first block (rule 3.5).
  bool starts_on_tool_side = false;
};

}  // namespace trc
