#pragma once

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// What becomes of an arc's equidistant between `start` and `end`. `left`: rad the corners
// leave of the programmed sweep, not positive where they consume it. Such an arc wraps round
// (90038), or, where loops are removed (`may_run_back`), is travelled backwards, as a line is.
// Up to Tolerances::same_point long it is a line.
[[nodiscard]] Segment shortened(const Arc& programmed, const Point& start, const Point& end,
                                double left, bool may_run_back, const Tolerances& tolerances);

// Gives `inserted` what all blocks inserted behind a block have in common; not the mode. Third
// axis and tracking axes stand still in them, where the block leaves them (D-26).
void insert_behind(const MotionBlock& before, const MotionBlock& after, MotionBlock& inserted);

[[nodiscard]] inline AxisTravel standing(double position) {
  return {.from = position, .to = position};
}

}  // namespace trc
