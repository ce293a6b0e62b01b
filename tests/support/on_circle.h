#pragma once

#include <cmath>

#include "core/geometry/segment.h"

namespace trc::support {

[[nodiscard]] inline Point on_circle(const Point& center, double radius, double angle) {
  return center + radius * Vector(std::cos(angle), std::sin(angle));
}

}  // namespace trc::support
