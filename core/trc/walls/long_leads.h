#pragma once

#include <cstddef>

#include "core/trc/walls/closing.h"

namespace trc {

// Whether two blocks are so near the ends that leads longer than the contour may end there.
[[nodiscard]] bool are_few_outside(const ContourView& contour, std::size_t first,
                                   std::size_t second);

// Whether leads that are longer than the contour part from it where its ends meet: few blocks, the
// ones beside the contour arcs or straight on, on the side of the tool (D-38).
[[nodiscard]] bool is_between_long_leads(const ContourView& contour, const EndsMeeting& closing,
                                         double tolerance);

}  // namespace trc
