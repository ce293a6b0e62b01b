#pragma once

#include "core/geometry/segment.h"
#include "core/verify/piece.h"

namespace trc::verify {

// The point of the segment that is nearest to `point`.
[[nodiscard]] Point nearest_point(const Segment& segment, const Point& point);

// The smallest distance of two segments, mm, and where on `a` it is reached; 0
// where they cross or touch.
struct Gap {
  double distance = 0;
  Point on_a = Point::Zero();
};
[[nodiscard]] Gap gap_between(const Line& a, const Line& b);
[[nodiscard]] Gap gap_between(const Segment& a, const Segment& b);
[[nodiscard]] Gap gap_between(const Piece& a, const Piece& b);

// All of one line lies so far, mm, beside the support of the other one, which tells in a few steps
// that they come no nearer. False: they may, or may not.
[[nodiscard]] bool are_apart(const Piece& a, const Piece& b, double distance);

// Of a line no point is nearer to any of the arc than one of its ends, and that is so far from it,
// mm: as at a corner the tool goes round, and where line and arc go on in each other.
[[nodiscard]] bool are_apart_at_end(const Piece& line, const Piece& arc, double distance);

// The unit travel direction at a point of the segment.
[[nodiscard]] Vector direction_at(const Segment& segment, const Point& point);

}  // namespace trc::verify
