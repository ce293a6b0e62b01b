#include "core/geometry/segment.h"

#include <cmath>
#include <numbers>

namespace trc {

Segment refitted(const Arc& arc, const Point& start, const Point& end, double same_point) {
  const Vector chord = end - start;
  if (chord.norm() <= same_point) return Line{.start = start, .end = end};
  const Vector across = left_of(chord).normalized();
  const Point middle = 0.5 * (start + end);
  const Point center = middle + (arc.center - middle).dot(across) * across;
  double sweep = turn_between(start - center, end - center);
  if (sweep * arc.sweep < 0) sweep += std::copysign(2 * std::numbers::pi, arc.sweep);
  return Arc{.start = start, .end = end, .center = center, .sweep = sweep};
}

}  // namespace trc
