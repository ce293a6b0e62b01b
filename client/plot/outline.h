#pragma once

#include <vector>

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/nc/block.h"

namespace trc::plot {

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

// A movement in `plane` with its travel across that plane, seen from the third
// axis of `view`. In its own plane it stays what it is; elsewhere arcs become
// chords no longer than 3 degrees, and a movement straight at the viewer
// becomes nothing.
[[nodiscard]] std::vector<Segment> project(Plane plane, const Segment& segment,
                                           const AxisTravel& normal, Plane view);

}  // namespace trc::plot
