#pragma once

#include <algorithm>
#include <cmath>

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
// Where it is `enough` or more, mm, it need not be all.
[[nodiscard]] Gap gap_between(const Piece& a, const Piece& b, double enough);

// All of one line lies at least so far, mm, on one side of the straight line that another one lies
// on. False: it may, or may not.
[[nodiscard]] inline bool is_beside(const Piece& line, const Piece& other, double distance) {
  const Vector along = line.end - line.start;
  const double at_start = cross(along, other.start - line.start);
  const double at_end = cross(along, other.end - line.start);
  return at_start * at_end > 0 && std::min(at_start * at_start, at_end * at_end) >=
                                      distance * distance * along.squaredNorm();
}

// No point of one is nearer to one of the other than `distance`, mm, which takes little to tell.
// False: they may be nearer, or not.
[[nodiscard]] inline bool are_apart(const Piece& a, const Piece& b, double distance) {
  return !a.is_arc() && !b.is_arc() && (is_beside(a, b, distance) || is_beside(b, a, distance));
}

// Of arcs about one centre, the second of at most half a turn: every direction from the centre that
// the first one passes is one that the second one passes.
[[nodiscard]] bool is_within(const Piece& arc, const Piece& other);

// The unit travel direction at a point of the segment.
[[nodiscard]] Vector direction_at(const Segment& segment, const Point& point);

}  // namespace trc::verify
