#include "core/trc/selection/tangential.h"

#include <cmath>
#include <numbers>

namespace trc::selection {
namespace {

// The arc that leaves `contact` along `tangent` and meets `other`.
std::optional<Segment> touching(const Point& contact, const Vector& tangent, const Point& other,
                                const Tolerances& tolerances) {
  const Vector to_other = other - contact;
  const double aside = to_other.dot(left_of(tangent));
  if (std::abs(aside) <= tolerances.same_point) {
    if (to_other.dot(tangent) < 0) return std::nullopt;
    return Line{.start = contact, .end = other};
  }
  const double radius = to_other.squaredNorm() / (2 * aside);  // positive: centre on the left
  const Point center = contact + radius * left_of(tangent);
  double sweep = turn_between(contact - center, other - center);
  if (sweep * radius < 0) sweep += std::copysign(2 * std::numbers::pi, radius);
  return Arc{.start = contact, .end = other, .center = center, .sweep = sweep};
}

}  // namespace

std::optional<Segment> tangential_entry(const Point& start, const Point& contact,
                                        const Vector& tangent, const Tolerances& tolerances) {
  std::optional<Segment> path = touching(contact, -tangent, start, tolerances);
  if (!path) return path;
  if (const auto* arc = std::get_if<Arc>(&*path))
    return Arc{.start = start, .end = contact, .center = arc->center, .sweep = -arc->sweep};
  return Line{.start = start, .end = contact};
}

std::optional<Segment> tangential_exit(const Point& contact, const Vector& tangent,
                                       const Point& target, const Tolerances& tolerances) {
  return touching(contact, tangent, target, tolerances);
}

}  // namespace trc::selection
