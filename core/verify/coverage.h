#pragma once

#include "core/geometry/segment.h"
#include "core/verify/piece.h"

namespace trc::verify {

// A stretch of a programmed block, mm from its start.
struct Stretch {
  double from = 0;
  double to = 0;

  [[nodiscard]] double length() const { return from < to ? to - from : 0; }
};

// What of `within` the path touches, where it runs beside the programmed block at the distance
// `required`. In the centre of an arc of that radius it touches all of it.
[[nodiscard]] Stretch touched(const Piece& programmed, const Stretch& within, const Piece& path,
                              double required);

// The part of a programmed block between two places.
[[nodiscard]] Segment part_of(const Segment& programmed, const Stretch& within);

}  // namespace trc::verify
