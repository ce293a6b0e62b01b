#pragma once

#include "core/geometry/segment.h"
#include "core/verify/box.h"
#include "core/verify/piece.h"

namespace trc::verify {

// All within `margin` of a straight line: what lies around a piece as narrowly as it takes to tell
// most walls apart from a path.
struct Capsule {
  Point center = Point::Zero();    // the middle of the line
  Vector half = Vector::Zero();    // from there to its end
  Vector normal = Vector::Zero();  // across the line, of length 1; 0: the line is a point
  double half_length = 0;          // mm
  double margin = 0;               // mm
};

// Holds all of the piece.
[[nodiscard]] Capsule capsule_of(const Piece& piece);
// It goes into the box around several.
inline void add_to(BoxAlong& box, const Capsule& capsule) {
  box.add(capsule.center + capsule.half, capsule.margin);
  box.add(capsule.center - capsule.half, capsule.margin);
}
// Holds all of the box.
[[nodiscard]] inline Capsule capsule_of(const Box& box) {
  return {.center = box.center,
          .half = box.half.x() * box.along,
          .normal = left_of(box.along),
          .half_length = box.half.x(),
          .margin = box.half.y()};
}

}  // namespace trc::verify
