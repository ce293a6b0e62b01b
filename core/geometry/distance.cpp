#include "core/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/intersect.h"

namespace trc {
namespace {

double distance_to_line(const Point& point, const Line& line) {
  const Vector along = line.end - line.start;
  const double squared = along.squaredNorm();
  if (squared == 0) return (point - line.start).norm();
  const double part = std::clamp((point - line.start).dot(along) / squared, 0.0, 1.0);
  return (point - (line.start + part * along)).norm();
}

double distance_to_arc(const Point& point, const Arc& arc) {
  const double to_ends = std::min((point - arc.start).norm(), (point - arc.end).norm());
  if (!covers(arc, point)) return to_ends;
  return std::min(to_ends, std::abs((point - arc.center).norm() - radius_of(arc)));
}

bool on_line(const Point& point, const Line& line, double same_point) {
  return distance_to_line(point, line) <= same_point;
}

}  // namespace

double distance(const Point& point, const Segment& segment) {
  return std::visit(overloaded{
                        [&](const Line& line) { return distance_to_line(point, line); },
                        [&](const Arc& arc) { return distance_to_arc(point, arc); },
                    },
                    segment);
}

bool covers(const Arc& arc, const Point& point) {
  double angle = turn_between(arc.start - arc.center, point - arc.center);
  if (angle * arc.sweep < 0) angle += std::copysign(2 * std::numbers::pi, arc.sweep);
  return std::abs(angle) <= std::abs(arc.sweep);
}

bool meet(const Line& line, const Segment& segment, double same_point) {
  const double length = (line.end - line.start).norm();
  if (length <= same_point) return distance(line.start, segment) <= same_point;
  const StraightLine straight{.point = line.start, .direction = (line.end - line.start) / length};
  if (const auto* arc = std::get_if<Arc>(&segment)) {
    const Circle circle{.center = arc->center, .radius = radius_of(*arc)};
    for (const Point& point : intersect(straight, circle, same_point))
      if (on_line(point, line, same_point) && distance_to_arc(point, *arc) <= same_point)
        return true;
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
