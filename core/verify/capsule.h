#pragma once

#include "core/geometry/segment.h"
#include "core/verify/box.h"
#include "core/verify/piece.h"

namespace trc::verify {

// All within `margin` of a straight line: what lies around a piece as narrowly as it takes to tell
// most walls apart from a path.
struct Capsule {
  Point center = Point::Zero();  // the middle of the line
  Vector half = Vector::Zero();  // from there to its end
  double margin = 0;             // mm
};

// Holds all of the piece.
[[nodiscard]] Capsule capsule_of_arc(const Piece& arc);
[[nodiscard]] inline Capsule capsule_of(const Piece& piece) {
  if (piece.is_arc()) return capsule_of_arc(piece);
  return {.center = 0.5 * (piece.start + piece.end), .half = 0.5 * (piece.end - piece.start)};
}
// It goes into the box around several.
inline void add_to(BoxAlong& box, const Capsule& capsule) {
  box.add(capsule.center + capsule.half, capsule.margin);
  box.add(capsule.center - capsule.half, capsule.margin);
}
// Holds all of the box.
[[nodiscard]] inline Capsule capsule_of(const Box& box) {
  return {.center = box.center, .half = box.half.x() * box.along, .margin = box.half.y()};
}

}  // namespace trc::verify
