#pragma once

#include "core/geometry/segment.h"
#include "core/verify/piece.h"

namespace trc::verify {

// A full circle with all in it: what lies around a piece in the quickest way.
struct Disk {
  Point center = Point::Zero();
  double radius = 0;  // mm
};

// Holds all of the piece.
[[nodiscard]] Disk disk_of(const Piece& piece);

// No point of one is nearer to one of the other, mm; negative: they overlap.
[[nodiscard]] inline double least_gap(const Disk& a, const Disk& b) {
  return (a.center - b.center).norm() - a.radius - b.radius;
}

}  // namespace trc::verify
