#pragma once

#include <optional>

#include "core/geometry/segment.h"
#include "core/trc/path_block.h"

namespace trc {

// The contour recovered from the tool path of a contour or transition block: the
// tool path moved back by the compensation (D-17, INVERSE).
//
// Neighbours do not join at inside corners, where the shortened blocks end; over
// a G26 arc it is a single point, the programmed corner, as a line without
// length. Empty for approach, retract and what is inserted across the contour.
[[nodiscard]] std::optional<Segment> inverse_path(const PathBlock& block, double same_point);

}  // namespace trc
