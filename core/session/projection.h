#pragma once

#include <vector>

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// A movement in `plane` with its travel across that plane, seen from the third
// axis of `view`. In its own plane it stays what it is; elsewhere arcs become
// chords no longer than 3 degrees, and a movement straight at the viewer
// becomes nothing.
[[nodiscard]] std::vector<Segment> project(Plane plane, const Segment& segment,
                                           const AxisTravel& normal, Plane view);

}  // namespace trc
