#pragma once

#include "core/trc/walls/closing.h"

namespace trc {

// Whether a lead-out crosses the first walls, or a lead-in the last ones, because the walls do not
// end where they begin: the part up to the crossing is a step, on which no contour closes. Such a
// lead is an arc that begins or ends with a wall, or a block of which less than half, and less than
// the tool width, would be a wall. Or any lead that runs beside the walls between the step and the
// crossing: a lead-out beside the first ones, a lead-in beside the last ones (D-96).
[[nodiscard]] bool is_lead_across_walls(const ContourView& contour, const EndsMeeting& meeting,
                                        double tolerance, double tool_radius);

}  // namespace trc
