#pragma once

#include "core/trc/walls/closing.h"

namespace trc {

// A lead-out that crosses the first walls, or a lead-in that crosses the last ones, because the
// walls do not end where they begin: what lies up to there is a step, and no contour closes on it.
// Such a lead is an arc that begins or ends with a wall, or a block of which less than half would
// be a wall, and that less than the tool is wide (D-96).
[[nodiscard]] bool is_lead_across_walls(const ContourView& contour, const EndsMeeting& meeting,
                                        double tolerance, double tool_radius);

}  // namespace trc
