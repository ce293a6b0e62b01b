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
// `required`. Up to the end of the block, where less than a micrometre is left standing between
// that and the end of the path.
[[nodiscard]] Stretch touched(const Piece& programmed, const Stretch& within, const Piece& path,
                              double required);

// All of a programmed block that has no path is touched from the place where the tool turns: an arc
// of its radius, in whose centre that is, or a line of which less than a micrometre is left
// standing.
[[nodiscard]] bool is_touched_from(const Point& place, const Piece& programmed, double required);

// The part of a programmed block between two places.
[[nodiscard]] Segment part_of(const Segment& programmed, const Stretch& within);

}  // namespace trc::verify
