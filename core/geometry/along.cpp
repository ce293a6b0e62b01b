#include "core/geometry/along.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/distance.h"
#include "core/geometry/intersect.h"

namespace trc {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

// A segment with what every question about places on it needs.
class Track {
 public:
  explicit Track(const Segment& segment) {
    start_ = start_of(segment);
    if (const auto* arc = std::get_if<Arc>(&segment)) {
      circle_ = {.center = arc->center, .radius = radius_of(*arc)};
      // Without radius it stands in one point, as a line without length does.
      circular_ = circle_.radius > 0;
      counter_clockwise_ = arc->sweep > 0;
      length_ = std::abs(arc->sweep) * circle_.radius;
      return;
    }
    const auto& line = std::get<Line>(segment);
    const Vector way = line.end - line.start;
    length_ = way.norm();
    direction_ = length_ > 0 ? Vector(way / length_) : Vector::UnitX();
  }

  [[nodiscard]] double length() const { return length_; }

  [[nodiscard]] Point at(double way) const {
    if (!circular_) return start_ + way * direction_;
    return circle_.center + turned(start_ - circle_.center, way);
  }

  [[nodiscard]] Vector tangent_at(double way) const {
    if (!circular_) return direction_;
    const Vector radial = turned(start_ - circle_.center, way) / circle_.radius;
    return counter_clockwise_ ? left_of(radial) : Vector(-left_of(radial));
  }

  // Of a point on the unbounded curve; up to `slack` behind the start it is negative.
  [[nodiscard]] double way_to(const Point& point, double slack) const {
    if (!circular_) return (point - start_).dot(direction_);
    double angle = turn_between(start_ - circle_.center, point - circle_.center);
    if (!counter_clockwise_) angle = -angle;
    if (angle * circle_.radius < -slack) angle += full_turn;
    return angle * circle_.radius;
  }

  [[nodiscard]] Meetings meetings_with(const StraightLine& line) const {
    return circular_ ? intersect(line, circle_, 0) : intersect(straight(), line);
  }
  [[nodiscard]] Meetings meetings_with(const Circle& circle) const {
    return circular_ ? intersect(circle_, circle, 0) : intersect(straight(), circle, 0);
  }
  [[nodiscard]] Meetings meetings_with(const Track& other) const {
    return other.circular_ ? meetings_with(other.circle_) : meetings_with(other.straight());
  }

 private:
  [[nodiscard]] StraightLine straight() const { return {.point = start_, .direction = direction_}; }

  [[nodiscard]] Vector turned(const Vector& radial, double way) const {
    const double angle = (counter_clockwise_ ? way : -way) / circle_.radius;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {cosine * radial.x() - sine * radial.y(), sine * radial.x() + cosine * radial.y()};
  }

  bool circular_ = false;
  bool counter_clockwise_ = false;
  Point start_ = Point::Zero();
  Vector direction_ = Vector::UnitX();
  Circle circle_{};
  double length_ = 0;
};

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
             .sweep = std::copysign(std::min(sweep, full_turn), arc->sweep)};
}

std::optional<double> first_entry(const Segment& path, double from, double to,
                                  const Segment& obstacle, double reach) {
  const Track track(path);
  const double half = 0.5 * (to - from);
  const Point middle = track.at(from + half);
  const double apart = distance(middle, obstacle);
  if (apart >= reach + half) return std::nullopt;
  Places places(track, from, to, middle);
  add_outline(obstacle, reach, track, places);
  const std::size_t count = places.sorted();
  if (count == 0) return apart < reach && from < to ? std::optional(from) : std::nullopt;
  double begin = from;
  for (std::size_t i = 0; i <= count; ++i) {
    const double end = i < count ? places[i] : to;
    if (end > begin && distance(track.at(0.5 * (begin + end)), obstacle) < reach) return begin;
    begin = end;
  }
  return std::nullopt;
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
