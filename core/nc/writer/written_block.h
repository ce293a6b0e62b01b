#pragma once

#include <variant>

#include "core/geometry/plane.h"
#include "core/nc/state/program_line.h"
#include "core/trc/result/compensated_block.h"

// The part of a compensated block that NC text can express.

namespace trc {

[[nodiscard]] inline MotionKind kind_of(const CompensatedBlock& block) {
  if (const Arc* arc = std::get_if<Arc>(&block.path))
    return arc->sweep < 0 ? MotionKind::clockwise : MotionKind::counter_clockwise;
  return block.rapid ? MotionKind::rapid : MotionKind::linear;
}

[[nodiscard]] inline bool moves_in_plane(const CompensatedBlock& block) {
  return is_arc(block.path) || start_of(block.path) != end_of(block.path);
}

[[nodiscard]] inline AxisSet plane_axes(Plane plane) {
  const PlaneAxes axes = axes_of(plane);
  return axis_bit(axes.first) | axis_bit(axes.second);
}

}  // namespace trc
