#pragma once

#include <cmath>

#include "core/geometry/segment.h"

namespace trc {

// The data of a segment that a planner needs. The directions of travel at its ends have any length.
struct Travel {
  Vector begins = Vector::Zero();
  Vector ends = Vector::Zero();
  double length = 0;  // mm
};

[[nodiscard]] inline Travel travel_of(const Line& line) {
  const Vector way = line.end - line.start;
  return {.begins = way, .ends = way, .length = way.norm()};
}

[[nodiscard]] inline Travel travel_of(const Arc& arc) {
  const double sense = arc.sweep > 0 ? 1 : -1;
  const Vector out = arc.start - arc.center;
  return {.begins = sense * left_of(out),
          .ends = sense * left_of(arc.end - arc.center),
          .length = std::abs(arc.sweep) * out.norm()};
}

}  // namespace trc
