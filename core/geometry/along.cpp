#include "core/geometry/along.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/distance.h"
#include "core/geometry/intersect.h"

namespace trc {
namespace {

// Places on a part of a track, in ascending order.
class Places {
 public:
  Places(const Track& track, double from, double to, const Point& middle)
      : track_(track), from_(from), to_(to), middle_(middle), farthest_(0.5 * 1.01 * (to - from)) {}

  // Adds the points where the track meets the circle. Here and below, a shape or a meeting farther
  // from the middle than the ends of the part is skipped: no meeting of it lies on the part.
  void add(const Circle& circle) {
    add(circle, [](const Point&) { return true; });
  }
  // Adds only meetings for which is_on(point) holds: the others are not on the outline.
  template <class IsOn>
  void add(const Circle& circle, IsOn is_on) {
    const double apart = (circle.center - middle_).squaredNorm();
    const double least = std::max(circle.radius - farthest_, 0.0);
    const double greatest = circle.radius + farthest_;
    if (apart >= least * least && apart <= greatest * greatest)
      add(track_.meetings_with(circle), is_on);
  }
  template <class IsOn>
  void add(const StraightLine& line, IsOn is_on) {
    if (std::abs(cross(line.direction, middle_ - line.point)) <= farthest_)
      add(track_.meetings_with(line), is_on);
  }

  [[nodiscard]] std::size_t sorted() {
    std::sort(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(count_));
    return count_;
  }
  [[nodiscard]] double operator[](std::size_t index) const { return places_[index]; }

 private:
  template <class IsOn>
  void add(const Meetings& meetings, IsOn is_on) {
    for (const Point& point : meetings) {
      if ((point - middle_).squaredNorm() > farthest_ * farthest_ || !is_on(point)) continue;
      const double way = track_.way_to(point, 0);
      if (way > from_ && way < to_) places_[count_++] = way;
    }
  }

  const Track& track_;
  double from_;
  double to_;
  Point middle_;
  double farthest_;
  std::array<double, 8> places_{};  // two shapes along the obstacle, two at its ends
  std::size_t count_ = 0;
};

void add_outline(const Arc& arc, double reach, Places& places) {
  const double radius = radius_of(arc);
  places.add({.center = arc.center, .radius = radius + reach});
  if (radius > reach) places.add({.center = arc.center, .radius = radius - reach});
  for (const Point& end : {arc.start, arc.end}) places.add({.center = end, .radius = reach});
}

// The outline has the parts of the two straight lines beside the obstacle, and the parts of the two
// circles beyond its ends. A meeting that is nearly a touch has only half of the digits.
void add_outline(const Line& line, double reach, double radius_of_track, Places& places) {
  const auto [direction, length] = directed(line.end - line.start);
  const double slack =
      length > 0 ? 0.01 * reach + 1e-6 * (line.start.lpNorm<1>() + length + radius_of_track)
                 : std::numeric_limits<double>::infinity();
  const auto along = [start = line.start, direction = direction](const Point& point) {
    return (point - start).dot(direction);
  };
  const double behind = length + slack;
  if (length > 0) {
    for (const double side : {reach, -reach})
      places.add(
          StraightLine{.point = line.start + side * left_of(direction), .direction = direction},
          [&](const Point& point) { return along(point) > -slack && along(point) < behind; });
  }
  places.add(Circle{.center = line.start, .radius = reach},
             [&](const Point& point) { return along(point) < slack; });
  places.add(Circle{.center = line.end, .radius = reach},
             [&, least = length - slack](const Point& point) { return along(point) > least; });
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
  if (const auto* arc = std::get_if<Arc>(&segment)) return stretch_of(*arc, from, to, start, end);
  return Line{.start = start, .end = end};
}

Arc stretch_of(const Arc& arc, double from, double to, const Point& start, const Point& end) {
  const double sweep = (to - from) / radius_of(arc);
  return {.start = start,
          .end = end,
          .center = arc.center,
          .sweep = std::copysign(std::min(sweep, 2 * std::numbers::pi), arc.sweep)};
}

std::optional<double> first_entry(const Segment& path, double from, double to,
                                  const Segment& obstacle, double reach) {
  return PathPart(path, from, to).first_entry(obstacle, reach);
}

std::optional<double> PathPart::first_entry(const Segment& obstacle, double reach) const {
  return first_entry(obstacle, distance(middle_, obstacle), reach);
}

bool PathPart::comes_nearer(const Segment& obstacle, double reach) const {
  const double apart = distance(middle_, obstacle);
  return apart < reach || first_entry(obstacle, apart, reach).has_value();
}

template <class Visit>
void PathPart::for_each_stretch(const Segment& obstacle, double apart, double reach,
                                Visit visit) const {
  const auto* line = std::get_if<Line>(&obstacle);
  Places places(track_, from_, to_, middle_);
  if (line != nullptr)
    add_outline(*line, reach, track_.radius(), places);
  else
    add_outline(std::get<Arc>(obstacle), reach, places);
  const std::size_t count = places.sorted();
  // `apart` is known at the middle of the part: it decides for the stretch well around it.
  const auto is_nearer = [&](double begin, double end) {
    const double margin = 0.25 * (end - begin);
    const double halfway = from_ + half_;
    if (halfway > begin + margin && halfway < end - margin) return apart < reach;
    return distance(track_.at(0.5 * (begin + end)), obstacle) < reach;
  };
  double begin = from_;
  for (std::size_t i = 0; i <= count; ++i) {
    const double end = i < count ? places[i] : to_;
    if (visit(begin, end, is_nearer)) return;
    begin = end;
  }
}

std::optional<double> PathPart::first_entry(const Segment& obstacle, double apart,
                                            double reach) const {
  if (apart >= reach + half_) return std::nullopt;
  const auto* line = std::get_if<Line>(&obstacle);
  if (line != nullptr && stays_off(*line, apart, reach)) return std::nullopt;
  std::optional<double> entry;
  for_each_stretch(obstacle, apart, reach, [&](double begin, double end, const auto& is_nearer) {
    if (end > begin && is_nearer(begin, end)) entry = begin;
    return entry.has_value();
  });
  return entry;
}

// A stretch of up to `slack` before that may lie outside of reach.
double PathPart::first_exit(const Segment& obstacle, double reach, double slack) const {
  double exit = from_;
  const auto leaves = [&](double begin, double end, const auto& is_nearer) {
    if (end <= begin) return false;
    const bool nearer = is_nearer(begin, end);
    if (nearer) exit = end;
    return !nearer && end > from_ + slack;
  };
  for_each_stretch(obstacle, distance(middle_, obstacle), reach, leaves);
  return exit;
}

// The distance from a line is a convex function of the point: along the tangent in the middle it
// falls no faster than it does there. The path departs from the tangent by no more than its
// curvature allows, and the distance changes by no more than that. The rest has to exceed `reach`
// by a thousand times the rounding error of the coordinates.
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

Crossings crossings(const Track& one, const Track& other, double slack) {
  Crossings result;
  for (const Point& point : one.meetings_with(other)) {
    const double along_one = one.way_to(point, slack);
    if (along_one < -slack || along_one > one.length() + slack) continue;
    const double along_other = other.way_to(point, slack);
    if (along_other < -slack || along_other > other.length() + slack) continue;
    // The meeting of curves that run side by side is not exact to the last digits.
    if ((one.foot_of(point) - other.foot_of(point)).squaredNorm() > slack * slack) continue;
    result.found[result.count++] = {.along_first = std::clamp(along_one, 0.0, one.length()),
                                    .along_second = std::clamp(along_other, 0.0, other.length()),
                                    .point = point};
  }
  return result;
}

}  // namespace trc
