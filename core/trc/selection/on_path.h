#pragma once

#include <cstdint>
#include <optional>

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"
#include "core/nc/state/trc_mode.h"
#include "core/trc/corner/corner.h"

namespace trc::selection {

// The way around the corner from 90 degrees on; up to 180 degrees a line under G236_LIN.
enum class AroundCorner : std::uint8_t { arc, line };

[[nodiscard]] inline AroundCorner around_corner(const TrcMode& mode) {
  return mode.options.g236_lin ? AroundCorner::line : AroundCorner::arc;
}

// G236: the tool stays on the programmed selection block and changes over to the
// equidistant of the contour (rule 3.3, D-02).
//
//   alpha < 90 degrees        at the crossing of path and equidistant
//   90 … 180, G236_LIN = 1    R before the corner, then a line to P
//   otherwise                 R before the corner, then an arc around it to P
//
// `selection` is the programmed selection (deselection) block, `tangent` its
// direction at the corner. The cut of the joint on its side is one of the
// programmed block. Empty when the block is too short for that (D-03).
[[nodiscard]] std::optional<Joint> approach_on_path(const Corner& corner, const Segment& selection,
                                                    const Vector& tangent, AroundCorner around,
                                                    const Tolerances& tolerances);
[[nodiscard]] std::optional<Joint> retract_on_path(const Corner& corner, const Segment& deselection,
                                                   const Vector& tangent, AroundCorner around,
                                                   const Tolerances& tolerances);

// The length that the block needs for that, mm, if it is extended before its start (after its end);
// none: no length gives such a point.
[[nodiscard]] std::optional<double> needed_on_path(const Corner& corner, const Segment& selection,
                                                   const Vector& tangent, AroundCorner around,
                                                   const Tolerances& tolerances);
[[nodiscard]] std::optional<double> needed_off_path(const Corner& corner,
                                                    const Segment& deselection,
                                                    const Vector& tangent, AroundCorner around,
                                                    const Tolerances& tolerances);

}  // namespace trc::selection
