#pragma once

#include "core/geometry/segment.h"

namespace trc {

// The point moved sideways by `shift` mm, to the left of `tangent` if positive.
// `tangent` is a unit vector. Everything in core/ that needs an end point of an
// equidistant takes it from here, so that equal questions have equal bits.
[[nodiscard]] inline Point parallel_point(const Point& point, const Vector& tangent, double shift) {
  return point + shift * left_of(tangent);
}

// The radius of the circle that is `shift` mm to the left of the arc; not
// positive when the arc would vanish. `radius`: of the arc, where it is known.
[[nodiscard]] inline double parallel_radius(const Arc& arc, double radius, double shift) {
  return radius - (arc.sweep > 0 ? shift : -shift);
}
[[nodiscard]] inline double parallel_radius(const Arc& arc, double shift) {
  return parallel_radius(arc, radius_of(arc), shift);
}

}  // namespace trc
