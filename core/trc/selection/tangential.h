#pragma once

#include <optional>

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"

namespace trc::selection {

// G05: the selection block becomes an arc from `start` that runs into the contour
// point `contact` along `tangent` (rule 3.7); a line when `start` lies straight
// behind it. Empty when it lies straight ahead (D-04).
[[nodiscard]] std::optional<Segment> tangential_entry(const Point& start, const Point& contact,
                                                      const Vector& tangent,
                                                      const Tolerances& tolerances);

// The arc of the way out: leaves `contact` along `tangent` to `target`.
[[nodiscard]] std::optional<Segment> tangential_exit(const Point& contact, const Vector& tangent,
                                                     const Point& target,
                                                     const Tolerances& tolerances);

}  // namespace trc::selection
