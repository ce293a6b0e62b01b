#pragma once

#include <optional>
#include <string>

#include "core/geometry/plane.h"
#include "core/nc/state/circle.h"

namespace trc {

// How a program writes a circle.
struct CircleWords {
  Plane plane = Plane::xy;
  bool absolute_center = false;  // of I, J and K
  bool klartext = false;         // CC
  LengthUnit unit = LengthUnit::mm;
};

// "I25 J0, X0 Y40 → X40 Y40": the words of a circle that do not fit together, in the unit of the
// program. A circle with a radius has no centre: then its ends alone.
[[nodiscard]] std::string told_circle(const CircleEnds& ends, const std::optional<Point>& center,
                                      const CircleWords& words);

}  // namespace trc
