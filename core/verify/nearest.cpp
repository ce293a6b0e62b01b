#include "core/verify/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace trc::verify {
namespace {

Point nearest_on(const Line& line, const Point& point) {
  const Vector along = line.end - line.start;
  const double square = along.squaredNorm();
  if (square == 0) return line.start;
  const double share = (point - line.start).dot(along) / square;
  if (share <= 0) return line.start;
  if (share >= 1) return line.end;
  return line.start + share * along;
}

// Whether `out` lies in the sector of at most half a turn from `first` to the left.
bool is_between(const Vector& first, const Vector& last, const Vector& out) {
  // A sector of next to nothing, whose ends rounding has changed about, has nothing opposite it.
  if (first.dot(last) > 0 && out.dot(first) < 0) return false;
  return cross(first, out) >= 0 && cross(out, last) >= 0;
}

bool is_in_sector(const Arc& arc, const Vector& from, const Vector& out) {
  const Vector to = arc.end - arc.center;
  const bool turns_left = arc.sweep > 0;
  const Vector& first = turns_left ? from : to;
  const Vector& last = turns_left ? to : from;
  return std::abs(arc.sweep) <= std::numbers::pi ? is_between(first, last, out)
                                                 : !is_between(last, first, out);
}

Point nearest_on(const Arc& arc, const Point& point) {
  const Vector from = arc.start - arc.center;
  const Vector out = point - arc.center;
  const double distance = out.norm();
  if (distance == 0) return arc.start;
  if (is_in_sector(arc, from, out)) return arc.center + out * (from.norm() / distance);
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

// Arcs at least one of them: the smallest distance is taken at an end of one of the two, at a
// common point, or where a line through a centre meets both at right angles. Each candidate is
// drawn onto `a` first, so that a wrong one can only be too far away.
Gap gap_of_bows(const Segment& a, const Segment& b) {
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

bool is_beside(const Piece& line, const Piece& other, double distance) {
  const Vector along = line.end - line.start;
  const double at_start = cross(along, other.start - line.start);
  const double at_end = cross(along, other.end - line.start);
  if (!(at_start * at_end > 0)) return false;
  const double least = std::min(std::abs(at_start), std::abs(at_end));
  return least * least >= distance * distance * along.squaredNorm();
}

}  // namespace

bool are_apart(const Piece& a, const Piece& b, double distance) {
  return is_beside(a, b, distance) || is_beside(b, a, distance);
}

// All of the arc lies behind the end, as seen along the line: its centre does, and both radii to
// its ends lead no farther, between which all others are.
bool are_apart_at_end(const Piece& line, const Piece& arc, double distance) {
  if (std::abs(arc.sweep) > std::numbers::pi) return false;
  const Vector to_start = arc.start - arc.center;
  const Vector to_end = arc.end - arc.center;
  const Vector along = line.end - line.start;
  const double square = along.squaredNorm();
  // What rounding leaves of a right angle brings them nearer by the square of this.
  constexpr double square_of_angle = 1e-18;
  const auto leads_on = [&](const Vector& way, double sense) {
    const double on = sense * way.dot(along);
    return on > 0 && on * on > square_of_angle * square * way.squaredNorm();
  };
  for (const double sense : {1.0, -1.0}) {
    const Vector out = arc.center - (sense > 0 ? line.start : line.end);
    if (leads_on(out, sense) || leads_on(to_start, sense) || leads_on(to_end, sense)) continue;
    // Start and end may lie on circles that differ a little.
    const double apart = out.norm();
    const double start = to_start.norm();
    const double end = to_end.norm();
    return std::max(std::min(start, end) - apart, apart - std::max(start, end)) >= distance;
  }
  return false;
}

Point nearest_point(const Segment& segment, const Point& point) {
  return std::visit([&](const auto& shape) { return nearest_on(shape, point); }, segment);
}

// Where they do not cross, an end of one of them is nearest. Of two on one line rounding makes a
// crossing anywhere: that counts by what is measured there.
Gap gap_between(const Line& a, const Line& b) {
  const Vector u = a.end - a.start;
  const Vector v = b.end - b.start;
  const Vector apart = b.start - a.start;
  const double area = cross(u, v);
  const double on_a = cross(apart, v) / area;
  const double on_b = cross(apart, u) / area;
  Gap gap;
  double least = std::numeric_limits<double>::infinity();
  const auto note = [&](const Point& at, const Point& other) {
    const double square = (at - other).squaredNorm();
    if (!(square < least)) return;
    least = square;
    gap.on_a = at;
  };
  if (on_a >= 0 && on_a <= 1 && on_b >= 0 && on_b <= 1) {
    const Point crossing = a.start + on_a * u;
    note(crossing, nearest_on(b, crossing));
  }
  note(a.start, nearest_on(b, a.start));
  note(a.end, nearest_on(b, a.end));
  note(nearest_on(a, b.start), b.start);
  note(nearest_on(a, b.end), b.end);
  gap.distance = std::sqrt(least);
  return gap;
}

Gap gap_between(const Segment& a, const Segment& b) {
  const auto* line_a = std::get_if<Line>(&a);
  const auto* line_b = std::get_if<Line>(&b);
  return line_a != nullptr && line_b != nullptr ? gap_between(*line_a, *line_b) : gap_of_bows(a, b);
}

Gap gap_between(const Piece& a, const Piece& b) {
  if (!a.is_arc() && !b.is_arc())
    return gap_between(Line{.start = a.start, .end = a.end}, Line{.start = b.start, .end = b.end});
  return gap_of_bows(segment_of(a), segment_of(b));
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
