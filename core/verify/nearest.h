#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

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

// The line lies beyond the circles or within them, and nowhere nearer to them than `distance`, mm.
// False: it may be nearer, or not.
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

// All of a line lies behind the centre of an arc, seen from every place of that, as the walls at a
// corner that the path turns about: neither is nearer to the other one than `distance`, mm. False:
// it may be, or not. `circles`: those of the arc.
[[nodiscard]] inline bool looks_away(const Piece& arc, const Circles& circles, const Piece& line,
                                     double distance) {
  const Vector from = arc.start - arc.center;
  const Vector to = arc.end - arc.center;
  // Up to 120 degrees a direction between both ends is a sum of them, with one of the two in all
  // at least and two of them at most.
  if (std::abs(arc.sweep) > std::numbers::pi || from.dot(to) < -0.5 * from.squaredNorm())
    return false;
  const double room = (circles.inner - distance) * circles.inner;
  const Vector start = line.start - arc.center;
  const Vector end = line.end - arc.center;
  return std::max(std::max(start.dot(from), start.dot(to)), std::max(end.dot(from), end.dot(to))) <=
         (room > 0 ? 0.5 * room : room);
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
    if (piece_.is_arc())
      return looks_away(piece_, circles_, other, distance) || are_apart(circles_, other, distance);
    if (other.is_arc()) {
      const Circles circles = circles_of(other);
      return are_apart(circles, piece_, distance) || looks_away(other, circles, piece_, distance);
    }
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
