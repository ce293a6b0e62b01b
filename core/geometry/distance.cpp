#include "core/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/intersect.h"

namespace trc {
namespace {

// The point of the segment that is nearest to `point`.
Point nearest_on(const Segment& segment, const Point& point) {
  if (const auto* line = std::get_if<Line>(&segment)) {
    const Vector along = line->end - line->start;
    const double squared = along.squaredNorm();
    if (squared == 0) return line->start;
    return line->start + std::clamp((point - line->start).dot(along) / squared, 0.0, 1.0) * along;
  }
  const Arc& arc = std::get<Arc>(segment);
  const Vector radial = point - arc.center;
  const double length = radial.norm();
  if (length > 0 && covers(arc, point)) return arc.center + (radius_of(arc) / length) * radial;
  return (point - arc.start).norm() <= (point - arc.end).norm() ? arc.start : arc.end;
}

// The points where the unbounded curves of the two meet.
Meetings meetings_of(const Segment& first, const Segment& second, double same_point) {
  const auto straight = [](const Line& line) {
    return StraightLine{.point = line.start, .direction = (line.end - line.start).normalized()};
  };
  const auto circle = [](const Arc& arc) {
    return Circle{.center = arc.center, .radius = radius_of(arc)};
  };
  return std::visit(
      overloaded{
          [&](const Line& a, const Line& b) { return intersect(straight(a), straight(b)); },
          [&](const Line& a, const Arc& b) {
            return intersect(straight(a), circle(b), same_point);
          },
          [&](const Arc& a, const Line& b) {
            return intersect(straight(b), circle(a), same_point);
          },
          [&](const Arc& a, const Arc& b) { return intersect(circle(a), circle(b), same_point); },
      },
      first, second);
}

bool on_line(const Point& point, const Line& line, double same_point) {
  return distance(point, line) <= same_point;
}

}  // namespace

double distance(const Point& point, const Arc& arc) {
  const double to_ends = std::min((point - arc.start).norm(), (point - arc.end).norm());
  if (!covers(arc, point)) return to_ends;
  return std::min(to_ends, std::abs((point - arc.center).norm() - radius_of(arc)));
}

// The distance of two curves is taken where they meet, at an end of one of them,
// or where both are square to the connecting line: for a circle that line runs
// through its centre.
Nearness nearness(const Segment& first, const Segment& second, double same_point) {
  Nearness nearest{.distance = std::numeric_limits<double>::infinity()};
  const auto consider = [&](const Point& on_first) {
    const double apart = distance(on_first, second);
    if (apart < nearest.distance) nearest = {.distance = apart, .on_first = on_first};
  };
  consider(start_of(first));
  consider(end_of(first));
  consider(nearest_on(first, start_of(second)));
  consider(nearest_on(first, end_of(second)));
  const auto* arc_first = std::get_if<Arc>(&first);
  const auto* arc_second = std::get_if<Arc>(&second);
  if (arc_second != nullptr) consider(nearest_on(first, arc_second->center));
  if (arc_first != nullptr) {
    const Point& center = arc_first->center;
    const Point target = arc_second != nullptr ? arc_second->center : nearest_on(second, center);
    const Vector way = target - center;
    const double length = way.norm();
    if (length > 0) {
      const Vector radial = (radius_of(*arc_first) / length) * way;
      for (const Point& point : {Point(center + radial), Point(center - radial)})
        if (covers(*arc_first, point)) consider(point);
    }
  }
  if (length_of(first) > 0 && length_of(second) > 0) {
    for (const Point& point : meetings_of(first, second, same_point))
      if (distance(point, first) <= same_point) consider(nearest_on(first, point));
  }
  return nearest;
}

// By signs alone, without angles: the ends divide the circle into a smaller and a larger arc.
bool covers(const Arc& arc, const Point& point) {
  const Vector to_start = arc.start - arc.center;
  const Vector to_end = arc.end - arc.center;
  const Vector way = point - arc.center;
  const double sense = std::copysign(1.0, arc.sweep);
  const double behind_start = sense * cross(to_start, way);
  const double before_end = sense * cross(way, to_end);
  // A point opposite a thin sector is on the right side of both of its edges too.
  const bool thin = to_start.dot(to_end) > 0;
  const bool opposite = thin && way.dot(to_start + to_end) < 0;
  if (std::abs(arc.sweep) <= std::numbers::pi)
    return behind_start >= 0 && before_end >= 0 && !opposite;
  return behind_start >= 0 || before_end >= 0 || opposite;
}

bool meet(const Line& line, const Segment& segment, double same_point) {
  const double length = (line.end - line.start).norm();
  if (length <= same_point) return distance(line.start, segment) <= same_point;
  const StraightLine straight{.point = line.start, .direction = (line.end - line.start) / length};
  if (const auto* arc = std::get_if<Arc>(&segment)) {
    const Circle circle{.center = arc->center, .radius = radius_of(*arc)};
    for (const Point& point : intersect(straight, circle, same_point))
      if (on_line(point, line, same_point) && distance(point, *arc) <= same_point) return true;
    return false;
  }
  const auto& other = std::get<Line>(segment);
  // Parallel pieces meet when an end of one lies on the other.
  if (on_line(line.start, other, same_point) || on_line(line.end, other, same_point) ||
      on_line(other.start, line, same_point) || on_line(other.end, line, same_point))
    return true;
  const double other_length = (other.end - other.start).norm();
  if (other_length <= same_point) return false;
  const StraightLine other_straight{.point = other.start,
                                    .direction = (other.end - other.start) / other_length};
  for (const Point& point : intersect(straight, other_straight))
    if (on_line(point, line, same_point) && on_line(point, other, same_point)) return true;
  return false;
}

}  // namespace trc
