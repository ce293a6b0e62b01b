#pragma once

#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/corner/corner.h"

namespace trc {

// A block on the short way, between its two corners.
struct ShortStep {
  MotionBlock* programmed = nullptr;
  double length = 0;         // of the programmed path, mm
  double extent = 0;         // of the programmed path, as extent_of()
  double radius = 1;         // of an arc: mm a unit of extent
  bool unreachable = false;  // as in PathBlock
  Vector tangent_at_start = Vector::UnitX();
  Point tool_start = Point::Zero();
  double cut_at_start = 0;  // as in PathBlock
};

// The corner between a block and the next one.
struct AtCorner {
  const Corner& corner;
  const ShortStep& before;
  ShortStep& after;
};

}  // namespace trc
