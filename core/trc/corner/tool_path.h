#pragma once

#include <cstdint>

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// The part of the equidistant of an arc that its corners leave.
struct LeftOfArc {
  Point start = Point::Zero();
  Point end = Point::Zero();
  double sweep = 0;  // rad, of the programmed one; not positive where they consume it
};

// The path of an arc that its corners consume.
enum class Consumed : std::uint8_t {
  wraps_round,  // 90038
  runs_back,    // as a line does, where loops are removed
};

// The path of such an arc. Up to Tolerances::same_point long it is a line.
[[nodiscard]] Segment shortened(const Arc& programmed, const LeftOfArc& left, Consumed consumed,
                                const Tolerances& tolerances);

// Sets in `inserted` what all blocks inserted after a block have in common, except the mode. Third
// axis and tracking axes stand still in them, where the block has left them (D-26).
void insert_behind(const MotionBlock& before, const MotionBlock& after, MotionBlock& inserted);

[[nodiscard]] inline AxisTravel standing(double position) {
  return {.from = position, .to = position};
}

}  // namespace trc
