#pragma once

#include <cstddef>

#include "core/trc/walls/closing.h"
#include "core/trc/walls/extent.h"

namespace trc {

// Whether two blocks are so near the ends that leads longer than the contour may end there.
[[nodiscard]] bool are_few_outside(const ContourView& contour, std::size_t first,
                                   std::size_t second);

// Whether leads longer than the contour leave it where its ends meet (D-38): few blocks, those next
// to the contour arcs or straight on, on the side of the tool; or any blocks that cross there,
// outside of a part that the contour goes round (D-98). `all`: the extent of the contour.
[[nodiscard]] bool is_between_long_leads(const ContourView& contour, const EndsMeeting& closing,
                                         const Extent& all, double tolerance, double tool_radius);

}  // namespace trc
