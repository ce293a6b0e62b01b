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

// The straight line that one lies on.
class Support {
 public:
  Support() = default;
  explicit Support(const Piece& line) : at_(line.start) {
    const Vector along = line.end - line.start;
    const double length = along.norm();
    if (length > 0) normal_ = left_of(along) / length;
  }
  // All of another line lies at least so far, mm, beside it. False: it may, or may not.
  [[nodiscard]] bool is_apart(const Piece& line, double distance) const {
    const double at_start = (line.start - at_).dot(normal_);
    const double at_end = (line.end - at_).dot(normal_);
    return at_start * at_end > 0 && std::min(std::abs(at_start), std::abs(at_end)) >= distance;
  }

 private:
  Point at_ = Point::Zero();
  Vector normal_ = Vector::Zero();  // of length 1; 0: it has no direction, and tells nothing
};

// Of arcs about one centre, the second of at most half a turn: every direction from the centre that
// the first one passes is one that the second one passes.
[[nodiscard]] bool is_within(const Piece& arc, const Piece& other);

// The unit travel direction at a point of the segment.
[[nodiscard]] Vector direction_at(const Segment& segment, const Point& point);

}  // namespace trc::verify
