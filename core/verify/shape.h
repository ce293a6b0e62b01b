#pragma once

#include "core/geometry/segment.h"

// Geometry that shares nothing with that of the compensation: what verifies a path must not
// repeat the faults of what has made it.
namespace trc::verify {

// The smallest upright rectangle around something; empty at first.
struct Bounds {
  Point low = Point::Zero();
  Point high = Point::Zero();
  bool empty = true;

  void add(const Point& point);
  // Arcs count with their whole bow, not with their ends alone.
  void add(const Segment& segment);
  [[nodiscard]] Vector size() const { return high - low; }
};

// mm; 0 for a segment without length.
[[nodiscard]] double extent_of(const Segment& segment);

// The point and the unit travel direction at `share` of the length, 0 … 1. The
// segment has a length.
struct Place {
  Point point = Point::Zero();
  Vector direction = Vector::UnitX();
};
[[nodiscard]] Place place_at(const Segment& segment, double share);

// Every number of the segment is finite.
[[nodiscard]] bool is_finite(const Segment& segment);

}  // namespace trc::verify
