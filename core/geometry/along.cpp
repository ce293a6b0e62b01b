#include "core/geometry/along.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/distance.h"
#include "core/geometry/intersect.h"
#include "core/geometry/track.h"

namespace trc {
namespace {

// Places on a track in ascending order.
class Places {
 public:
  Places(const Track& track, double from, double to, const Point& middle)
      : track_(track), from_(from), to_(to), middle_(middle) {}

  void add(const Meetings& meetings) {
    const double reach = 0.5 * (to_ - from_);
    for (const Point& point : meetings) {
      // Farther off than the way there is long: no need for an angle.
      if ((point - middle_).squaredNorm() > 1.01 * reach * reach) continue;
      const double way = track_.way_to(point, 0);
      if (way > from_ && way < to_) places_[count_++] = way;
    }
  }
  [[nodiscard]] std::size_t sorted() {
    std::sort(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(count_));
    return count_;
  }
  [[nodiscard]] double operator[](std::size_t index) const { return places_[index]; }

 private:
  const Track& track_;
  double from_;
  double to_;
  Point middle_;
  std::array<double, 8> places_{};  // two shapes along the obstacle, two at its ends
  std::size_t count_ = 0;
};

void add_outline(const Segment& obstacle, double reach, const Track& track, Places& places) {
  if (const auto* arc = std::get_if<Arc>(&obstacle)) {
    const double radius = radius_of(*arc);
    places.add(track.meetings_with(Circle{.center = arc->center, .radius = radius + reach}));
    if (radius > reach)
      places.add(track.meetings_with(Circle{.center = arc->center, .radius = radius - reach}));
  } else {
    const auto& line = std::get<Line>(obstacle);
    const Vector way = line.end - line.start;
    const double length = way.norm();
    if (length > 0) {
      const Vector direction = way / length;
      for (const double side : {reach, -reach})
        places.add(track.meetings_with(
            StraightLine{.point = line.start + side * left_of(direction), .direction = direction}));
    }
  }
  places.add(track.meetings_with(Circle{.center = start_of(obstacle), .radius = reach}));
  places.add(track.meetings_with(Circle{.center = end_of(obstacle), .radius = reach}));
}

}  // namespace

Point point_along(const Segment& segment, double way) { return Track(segment).at(way); }

Vector tangent_along(const Segment& segment, double way) { return Track(segment).tangent_at(way); }

double nearest_along(const Segment& segment, const Point& point) {
  const Track track(segment);
  const auto* arc = std::get_if<Arc>(&segment);
  if (arc == nullptr) return std::clamp(track.way_to(point, 0), 0.0, track.length());
  if (covers(*arc, point)) return std::min(track.way_to(point, 0), track.length());
  return (point - arc->start).norm() <= (point - arc->end).norm() ? 0 : track.length();
}

Segment stretch_of(const Segment& segment, double from, double to, const Point& start,
                   const Point& end) {
  const auto* arc = std::get_if<Arc>(&segment);
  if (arc == nullptr) return Line{.start = start, .end = end};
  const double sweep = (to - from) / radius_of(*arc);
  return Arc{.start = start,
             .end = end,
             .center = arc->center,
             .sweep = std::copysign(std::min(sweep, 2 * std::numbers::pi), arc->sweep)};
}

std::optional<double> first_entry(const Segment& path, double from, double to,
                                  const Segment& obstacle, double reach) {
  return PathPart(path, from, to).first_entry(obstacle, reach);
}

PathPart::PathPart(const Segment& path, double from, double to)
    : track_(path),
      from_(from),
      to_(to),
      half_(0.5 * (to - from)),
      middle_(track_.at(from + half_)),
      tangent_(track_.tangent_at(from + half_)) {}

std::optional<double> PathPart::first_entry(const Segment& obstacle, double reach) const {
  const auto* arc = std::get_if<Arc>(&obstacle);
  const double apart =
      arc != nullptr ? distance(middle_, *arc) : distance(middle_, std::get<Line>(obstacle));
  if (apart >= reach + half_) return std::nullopt;
  if (arc == nullptr && stays_off(std::get<Line>(obstacle), apart, reach)) return std::nullopt;
  Places places(track_, from_, to_, middle_);
  add_outline(obstacle, reach, track_, places);
  const std::size_t count = places.sorted();
  if (count == 0) return apart < reach && from_ < to_ ? std::optional(from_) : std::nullopt;
  double begin = from_;
  for (std::size_t i = 0; i <= count; ++i) {
    const double end = i < count ? places[i] : to_;
    if (end > begin && distance(track_.at(0.5 * (begin + end)), obstacle) < reach) return begin;
    begin = end;
  }
  return std::nullopt;
}

// The distance from a line is a convex function of the point, so that along the tangent in the
// middle it falls no faster than it does there; from the tangent the path departs by no more than
// its curvature lets it, and the distance changes by no more than that. What is left has to be out
// of reach by a thousand times what rounding does to the coordinates that take part.
bool PathPart::stays_off(const Line& obstacle, double apart, double reach) const {
  if (apart <= reach) return false;
  const Vector along = obstacle.end - obstacle.start;
  const double squared = along.squaredNorm();
  const Vector from_start = middle_ - obstacle.start;
  const double part = squared > 0 ? std::clamp(from_start.dot(along) / squared, 0.0, 1.0) : 0.0;
  const double slope = std::abs((from_start - part * along).dot(tangent_)) / apart;
  const double bent = bend();
  const double size = middle_.lpNorm<1>() + from_start.lpNorm<1>() + along.lpNorm<1>() +
                      track_.radius() + apart + half_;
  return apart - slope * half_ - bent > reach + 1e-13 * size;
}

Crossings crossings(const Segment& first, const Segment& second, double slack) {
  const Track one(first);
  const Track other(second);
  Crossings result;
  for (const Point& point : one.meetings_with(other)) {
    const double along_one = one.way_to(point, slack);
    const double along_other = other.way_to(point, slack);
    if (along_one < -slack || along_one > one.length() + slack) continue;
    if (along_other < -slack || along_other > other.length() + slack) continue;
    // Of curves that run side by side the meeting is not known to the last digits.
    if ((one.at(along_one) - other.at(along_other)).norm() > slack) continue;
    result.found[result.count++] = {.along_first = std::clamp(along_one, 0.0, one.length()),
                                    .along_second = std::clamp(along_other, 0.0, other.length()),
                                    .point = point};
  }
  return result;
}

}  // namespace trc
