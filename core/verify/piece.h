#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/segment.h"
#include "core/verify/box.h"

namespace trc::verify {

// As norm(), but always inlined: it is taken of every block several times.
[[nodiscard]] inline double magnitude(const Vector& vector) {
  return std::sqrt(vector.x() * vector.x() + vector.y() * vector.y());
}

// A line or an arc, as small as it can be kept: a selection may have millions of them.
struct Piece {
  Point start = Point::Zero();
  Point end = Point::Zero();
  Point center = Point::Zero();  // of an arc
  double sweep = 0;              // rad, as Arc::sweep; 0: a line

  [[nodiscard]] bool is_arc() const { return sweep != 0; }
  [[nodiscard]] double radius() const { return magnitude(start - center); }
  // mm, of a line or an arc.
  [[nodiscard]] double length() const {
    return is_arc() ? radius() * std::abs(sweep) : magnitude(end - start);
  }
  // It has no length.
  [[nodiscard]] bool is_point() const {
    return (is_arc() ? start - center : end - start).squaredNorm() == 0;
  }
  bool operator==(const Piece&) const = default;
};

// What an arc of no more than half a turn rises above its chord, mm, at most: `bow` is the unit
// vector across the chord, towards the arc.
[[nodiscard]] inline double rise_of(const Piece& arc, double largest_radius, const Vector& bow) {
  return std::max(0.0, largest_radius - (arc.start - arc.center).dot(bow));
}

[[nodiscard]] Piece piece_of(const Segment& segment);
[[nodiscard]] Segment segment_of(const Piece& piece);

// A box that holds all of the piece: along its chord, or upright around the whole circle where the
// arc is more than half of one.
[[nodiscard]] Box box_of(const Piece& piece);

// The distances from `center` of all points of the piece lie between these, mm.
[[nodiscard]] Ring ring_of(const Piece& piece, const Point& center);

}  // namespace trc::verify
