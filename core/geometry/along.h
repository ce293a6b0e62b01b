#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/base/tolerances.h"
#include "core/geometry/four_boxes.h"
#include "core/geometry/segment.h"
#include "core/geometry/track.h"

namespace trc {

// Places on a bounded segment, given by the way from its start, mm.

// Places this close count as one: two digits below what makes two points one, and two above what a
// double resolves at the largest coordinate.
[[nodiscard]] inline double slack_of_places(const Tolerances& tolerances) {
  constexpr double share_of_point = 0.01;
  return share_of_point * tolerances.same_point;
}

[[nodiscard]] Point point_along(const Segment& segment, double way);
// The unit vector of travel at that place; defined for a segment without length too.
[[nodiscard]] Vector tangent_along(const Segment& segment, double way);
// The place nearest to `point`, between the ends.
[[nodiscard]] double nearest_along(const Segment& segment, const Point& point);

// Whether it is an arc without radius, which stays at the end of the segment before.
[[nodiscard]] inline bool has_no_radius(const Segment& segment) {
  const auto* arc = std::get_if<Arc>(&segment);
  return arc != nullptr && arc->start == arc->center;
}

// The stretch between two places, with the ends as given: they are those of its
// neighbours, bit for bit.
[[nodiscard]] Segment stretch_of(const Segment& segment, double from, double to, const Point& start,
                                 const Point& end);
[[nodiscard]] Arc stretch_of(const Arc& arc, double from, double to, const Point& start,
                             const Point& end);

// Where on `path`, not before `from` and before `to`, it comes nearer than `reach`
// to `obstacle`; empty if it does not. A touch is not nearer.
//
//     ----- path -----o=======>        The places where the path can cross the
//                  .-'  `.             outline of all that is within reach are
//                 |   -------          collected; between two of them it is on
//                  `-.  .---           one side throughout, which one point tells.
[[nodiscard]] std::optional<double> first_entry(const Segment& path, double from, double to,
                                                const Segment& obstacle, double reach);

// A path between two places, for several such questions.
class PathPart {
 public:
  PathPart(const Segment& path, double from, double to) : PathPart(Track(path), from, to) {}
  // The part of it before `to`.
  [[nodiscard]] PathPart until(double to) const { return {track_, from_, to}; }

  [[nodiscard]] double half_length() const { return half_; }
  [[nodiscard]] const Point& middle() const { return middle_; }
  // A course for FourBoxes: obstacles that it does not enter are not nearer than `reach`.
  [[nodiscard]] FourBoxes::Course course(double reach) const {
    return {middle_, tangent_, half_, bend(), reach};
  }
  // As above.
  [[nodiscard]] std::optional<double> first_entry(const Segment& obstacle, double reach) const;
  // Whether there is one.
  [[nodiscard]] bool comes_nearer(const Segment& obstacle, double reach) const;
  // The way up to which it stays nearer than `reach`, as it is from its start on, within `slack`.
  [[nodiscard]] double first_exit(const Segment& obstacle, double reach, double slack) const;

 private:
  PathPart(const Track& track, double from, double to)
      : PathPart(track, track.pose_at(from + 0.5 * (to - from)), from, to) {}
  PathPart(const Track& track, const Track::Pose& middle, double from, double to)
      : track_(track),
        from_(from),
        to_(to),
        half_(0.5 * (to - from)),
        middle_(middle.point),
        tangent_(middle.tangent) {}

  // `apart` is the distance of its middle.
  [[nodiscard]] std::optional<double> first_entry(const Segment& obstacle, double apart,
                                                  double reach) const;
  // Calls visit(begin, end, is_nearer), until it returns true, for all stretches of it in order.
  template <class Visit>
  void for_each_stretch(const Segment& obstacle, double apart, double reach, Visit visit) const;
  // The largest distance from the tangent in its middle.
  [[nodiscard]] double bend() const { return 0.5 * half_ * half_ * track_.curvature(); }
  // Whether it certainly comes no nearer than `reach`.
  [[nodiscard]] bool stays_off(const Line& obstacle, double apart, double reach) const;

  Track track_;
  double from_;
  double to_;
  double half_;
  Point middle_;
  Vector tangent_;
};

// A point two segments have in common, and how far along each it is.
struct Crossing {
  double along_first = 0;
  double along_second = 0;
  Point point = Point::Zero();
};
struct Crossings {
  std::array<Crossing, 2> found{};
  std::size_t count = 0;

  [[nodiscard]] const Crossing* begin() const { return found.data(); }
  [[nodiscard]] const Crossing* end() const { return found.data() + count; }
};

// Segments, as tracks, that miss each other by up to `slack` mm cross, also at their ends.
// Those that run into one another along a stretch have no crossing.
[[nodiscard]] Crossings crossings(const Track& first, const Track& second, double slack);

}  // namespace trc
