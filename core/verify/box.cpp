#include "core/verify/box.h"

#include <array>
#include <cmath>

namespace trc::verify {
namespace {

// Half the size of a box in a frame turned by the angle with this cosine and sine.
Vector half_in(const Vector& half, double cosine, double sine) {
  const double c = std::abs(cosine);
  const double s = std::abs(sine);
  return {c * half.x() + s * half.y(), s * half.x() + c * half.y()};
}

Vector in_frame(const Vector& along, const Vector& v) { return {along.dot(v), cross(along, v)}; }

// The bounds of two boxes in a frame along `along`, from the centre of the first one.
struct Extent {
  Vector along;
  Vector low;
  Vector high;
};

Extent extent_along(const Box& a, const Box& b, const Vector& along) {
  const Vector half_a = half_in(a.half, along.dot(a.along), cross(along, a.along));
  const Vector half_b = half_in(b.half, along.dot(b.along), cross(along, b.along));
  const Vector apart = in_frame(along, b.center - a.center);
  return {.along = along,
          .low = Vector(-half_a).cwiseMin(Vector(apart - half_b)),
          .high = half_a.cwiseMax(Vector(apart + half_b))};
}

// Boxes without width differ only in length.
bool is_smaller(const Extent& a, const Extent& b) {
  const Vector size_a = a.high - a.low;
  const Vector size_b = b.high - b.low;
  const double area_a = size_a.x() * size_a.y();
  const double area_b = size_b.x() * size_b.y();
  return area_a != area_b ? area_a < area_b : size_a.sum() < size_b.sum();
}

double gap_in_frame_of(const Box& own, const Box& other, double cosine, double sine) {
  const Vector apart = in_frame(own.along, other.center - own.center);
  const Vector gap =
      (apart.cwiseAbs() - own.half - half_in(other.half, cosine, sine)).cwiseMax(Vector::Zero());
  return gap.norm();
}

}  // namespace

Box around(const Box& a, const Box& b) {
  Extent best = extent_along(a, b, a.along);
  const Vector between = b.center - a.center;
  const double distance = between.norm();
  const std::array<Vector, 2> others{b.along, distance > 0 ? Vector(between / distance) : a.along};
  for (const Vector& along : others) {
    const Extent extent = extent_along(a, b, along);
    if (is_smaller(extent, best)) best = extent;
  }
  const Vector middle = 0.5 * (best.low + best.high);
  return {.center = a.center + middle.x() * best.along + middle.y() * left_of(best.along),
          .along = best.along,
          .half = 0.5 * (best.high - best.low)};
}

double least_gap(const Box& a, const Box& b, double enough) {
  // Most boxes are far apart, and so are the circles around them.
  const double around = a.half.sum() + b.half.sum() + std::max(enough, 0.0);
  if ((a.center - b.center).squaredNorm() >= around * around) return enough;
  const double cosine = a.along.dot(b.along);
  const double sine = cross(a.along, b.along);
  const double gap = gap_in_frame_of(a, b, cosine, sine);
  return gap >= enough ? gap : std::max(gap, gap_in_frame_of(b, a, cosine, -sine));
}

Box BoxAlong::box() const {
  const Vector middle = 0.5 * (low_ + high_);
  return {.center = middle.x() * along_ + middle.y() * left_of(along_),
          .along = along_,
          .half = 0.5 * (high_ - low_)};
}

Ring ring_of(const Box& box, const Point& center) {
  const Vector apart = in_frame(box.along, center - box.center).cwiseAbs();
  const Vector nearest = (apart - box.half).cwiseMax(Vector::Zero());
  return {.center = center, .inner = nearest.norm(), .outer = (apart + box.half).norm()};
}

}  // namespace trc::verify
