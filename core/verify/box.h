#pragma once

#include <algorithm>
#include <limits>

#include "core/geometry/segment.h"

namespace trc::verify {

// A rectangle that lies as what it holds does: a long thin one along a slanted contour. What is
// upright would be as wide as high there, and would be near to everything.
struct Box {
  Point center = Point::Zero();
  Vector along = Vector::UnitX();  // of length 1; the other axis is on its left
  Vector half = Vector::Zero();    // half of its size along and across, mm
};

// Around both: along one of them or from one to the other, whatever is smallest.
[[nodiscard]] Box around(const Box& a, const Box& b);

// No point of one box is nearer to one of the other, mm. Where it is `enough` or more, it need not
// be all.
[[nodiscard]] double least_gap(const Box& a, const Box& b, double enough);

// Around all that is added, one side of it along a unit vector.
class BoxAlong {
 public:
  explicit BoxAlong(const Vector& along = Vector::UnitX()) : along_(along) {}
  // All within `margin` of a point.
  void add(const Point& point, double margin) {
    const double along = along_.dot(point);
    const double across = cross(along_, point);
    low_ = {std::min(low_.x(), along - margin), std::min(low_.y(), across - margin)};
    high_ = {std::max(high_.x(), along + margin), std::max(high_.y(), across + margin)};
  }
  // Of what is not empty.
  [[nodiscard]] Box box() const;

 private:
  Vector along_;
  Vector low_ = Vector::Constant(std::numeric_limits<double>::infinity());
  Vector high_ = Vector::Constant(-std::numeric_limits<double>::infinity());
};

// Everything between two circles about one centre. Tells concentric arcs apart, whose boxes
// overlap.
struct Ring {
  Point center = Point::Zero();
  double inner = 0;   // mm
  double outer = -1;  // mm; below `inner`: none
  [[nodiscard]] bool exists() const { return outer >= inner; }
};

// Around both, which have the same centre.
[[nodiscard]] inline Ring around(const Ring& a, const Ring& b) {
  return {
      .center = a.center, .inner = std::min(a.inner, b.inner), .outer = std::max(a.outer, b.outer)};
}

// All of the box lies between these distances from the point.
[[nodiscard]] Ring ring_of(const Box& box, const Point& center);

// No point of one is nearer to one of the other, mm; both have the same centre.
[[nodiscard]] inline double least_gap(const Ring& a, const Ring& b) {
  return std::max({0.0, a.inner - b.outer, b.inner - a.outer});
}

}  // namespace trc::verify
