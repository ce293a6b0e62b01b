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

// The circles that an arc lies between: its start and its end may lie on two that differ a little.
struct Circles {
  Point center = Point::Zero();
  double inner = 0;  // mm
  double outer = 0;  // mm
};
[[nodiscard]] inline Circles circles_of(const Piece& arc) {
  const double start = arc.radius();
  const double end = magnitude(arc.end - arc.center);
  return {.center = arc.center, .inner = std::min(start, end), .outer = std::max(start, end)};
}

// One circle lies beyond the other one or within it, and nowhere nearer to it than `distance`, mm.
// False: they may be nearer, or not.
[[nodiscard]] inline bool are_apart(const Circles& a, const Circles& b, double distance) {
  const double square = (b.center - a.center).squaredNorm();
  const double beyond = distance + a.outer + b.outer;
  const double within = std::max(a.inner - b.outer, b.inner - a.outer) - distance;
  return beyond <= 0 || square >= beyond * beyond || (within >= 0 && square <= within * within);
}

// The same of such circles and a line.
[[nodiscard]] inline bool are_apart(const Circles& circles, const Piece& line, double distance) {
  const Vector start = line.start - circles.center;
  const Vector end = line.end - circles.center;
  const Vector along = end - start;
  const double square = along.squaredNorm();
  const double across = cross(along, start);
  const double beyond = distance + circles.outer;
  const double within = circles.inner - distance;
  return beyond <= 0 || (square > 0 && across * across >= beyond * beyond * square) ||
         (within >= 0 && std::max(start.squaredNorm(), end.squaredNorm()) <= within * within);
}

// A piece that is compared with many, each of which takes little to be told apart from it.
class Compared {
 public:
  explicit Compared(const Piece& piece)
      : piece_(piece), circles_(piece.is_arc() ? circles_of(piece) : Circles{}) {}
  // No point of the other one is nearer than `distance`, mm. False: it may be nearer, or not.
  [[nodiscard]] bool is_apart_from(const Piece& other, double distance) const {
    if (piece_.is_arc() && other.is_arc()) {
      const Circles circles = circles_of(other);
      return are_apart(circles_, circles, distance) || is_beyond_ends(other, circles, distance);
    }
    if (piece_.is_arc()) return are_apart(circles_, other, distance);
    if (other.is_arc()) return are_apart(circles_of(other), piece_, distance);
    return is_beside(piece_, other, distance) || is_beside(other, piece_, distance);
  }

 private:
  // Of two arcs: seen from the centre of the first one, all of the other one lies beyond one of its
  // ends, so that its ends are nearest to that. Tells arcs apart that go on in one another.
  [[nodiscard]] bool is_beyond_ends(const Piece& other, const Circles& circles,
                                    double distance) const;

  const Piece& piece_;
  Circles circles_;  // of an arc
};

// Of arcs about one centre, the second of at most half a turn: every direction from the centre that
// the first one passes is one that the second one passes.
[[nodiscard]] bool is_within(const Piece& arc, const Piece& other);

// The unit travel direction at a point of the segment.
[[nodiscard]] Vector direction_at(const Segment& segment, const Point& point);

}  // namespace trc::verify
