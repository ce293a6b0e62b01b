#include "core/verify/nearest.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace trc::verify {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

Point nearest_on(const Line& line, const Point& point) {
  const Vector along = line.end - line.start;
  const double square = along.squaredNorm();
  if (square == 0) return line.start;
  const double share = (point - line.start).dot(along) / square;
  if (share <= 0) return line.start;
  if (share >= 1) return line.end;
  return line.start + share * along;
}

Point nearest_on(const Arc& arc, const Point& point) {
  const Vector from = arc.start - arc.center;
  const Vector out = point - arc.center;
  const double distance = out.norm();
  if (distance == 0) return arc.start;
  double turned = std::atan2(cross(from, out), from.dot(out));
  if (arc.sweep < 0) turned = -turned;
  if (turned < 0) turned += full_turn;
  if (turned <= std::abs(arc.sweep)) return arc.center + out * (from.norm() / distance);
  return (point - arc.start).squaredNorm() < (point - arc.end).squaredNorm() ? arc.start : arc.end;
}

// At most this many points of two supports can be nearest or in common.
struct Candidates {
  std::array<Point, 8> points;
  std::size_t count = 0;

  void add(const Point& point) {
    if (point.allFinite()) points[count++] = point;
  }
};

void add_supports(const Line& a, const Line& b, Candidates& candidates) {
  const Vector u = a.end - a.start;
  const Vector v = b.end - b.start;
  candidates.add(a.start + u * (cross(b.start - a.start, v) / cross(u, v)));
}

void add_supports(const Line& line, const Arc& arc, Candidates& candidates) {
  const Vector along = (line.end - line.start).normalized();
  const Point foot = line.start + along * (arc.center - line.start).dot(along);
  candidates.add(foot);
  const double radius = (arc.start - arc.center).norm();
  const double half = std::sqrt(radius * radius - (foot - arc.center).squaredNorm());
  candidates.add(foot + half * along);
  candidates.add(foot - half * along);
}

void add_supports(const Arc& a, const Arc& b, Candidates& candidates) {
  const Vector between = b.center - a.center;
  const double distance = between.norm();
  const Vector toward = between / distance;
  const double radius_a = (a.start - a.center).norm();
  const double radius_b = (b.start - b.center).norm();
  candidates.add(a.center + radius_a * toward);
  candidates.add(a.center - radius_a * toward);
  const double along =
      (distance * distance + radius_a * radius_a - radius_b * radius_b) / (2 * distance);
  const double half = std::sqrt(radius_a * radius_a - along * along);
  candidates.add(a.center + along * toward + half * left_of(toward));
  candidates.add(a.center + along * toward - half * left_of(toward));
}

void add_supports(const Arc& arc, const Line& line, Candidates& candidates) {
  add_supports(line, arc, candidates);
}

}  // namespace

Point nearest_point(const Segment& segment, const Point& point) {
  return std::visit([&](const auto& shape) { return nearest_on(shape, point); }, segment);
}

// The smallest distance is taken at an end of one of the two, at a common point,
// or where a line through a centre meets both at right angles. Each candidate is
// drawn onto `a` first, so that a wrong one can only be too far away.
Gap gap_between(const Segment& a, const Segment& b) {
  Candidates candidates;
  std::visit(
      [&](const auto& first, const auto& second) {
        candidates.add(first.start);
        candidates.add(first.end);
        candidates.add(second.start);
        candidates.add(second.end);
        add_supports(first, second, candidates);
      },
      a, b);
  Gap gap{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < candidates.count; ++i) {
    const Point on_a = nearest_point(a, candidates.points[i]);
    const double distance = (nearest_point(b, on_a) - on_a).norm();
    if (distance < gap.distance) gap = {.distance = distance, .on_a = on_a};
  }
  return gap;
}

Vector direction_at(const Segment& segment, const Point& point) {
  return std::visit(
      overloaded{[](const Line& line) { return Vector((line.end - line.start).normalized()); },
                 [&](const Arc& arc) {
                   const Vector left = left_of((point - arc.center).normalized());
                   return arc.sweep < 0 ? Vector(-left) : left;
                 }},
      segment);
}

}  // namespace trc::verify
