#include "tests/support/slow_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trc::support {
namespace {

constexpr Extended pi = std::numbers::pi_v<Extended>;
constexpr int points_between = 4;

ExtendedPoint wide(const Point& p) { return {p.x(), p.y()}; }
Point narrow(const ExtendedPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

std::vector<ExtendedPoint> line_and_line(const Carrier& a, const Carrier& b) {
  const Extended sine = cross(a.along, b.along);
  if (std::abs(sine) < 1e-15L) return {};
  return {a.point + (cross(b.point - a.point, b.along) / sine) * a.along};
}

std::vector<ExtendedPoint> line_and_circle(const Carrier& line, const Carrier& circle,
                                           Extended slack) {
  const ExtendedPoint foot = line.point + dot(circle.point - line.point, line.along) * line.along;
  const Extended off = length(foot - circle.point);
  if (off > circle.radius + slack) return {};
  if (off > circle.radius - slack) return {foot};
  const Extended half = std::sqrt((circle.radius - off) * (circle.radius + off));
  return {foot - half * line.along, foot + half * line.along};
}

std::vector<ExtendedPoint> circle_and_circle(const Carrier& a, const Carrier& b, Extended slack) {
  const ExtendedPoint between = b.point - a.point;
  const Extended apart = length(between);
  if (apart <= slack) return {};
  const ExtendedPoint axis = (1 / apart) * between;
  const Extended inner = std::abs(a.radius - b.radius);
  if (apart > a.radius + b.radius + slack || apart < inner - slack) return {};
  // From the centre of a to the chord the two points lie on.
  const Extended to_chord = (apart + (a.radius - b.radius) * ((a.radius + b.radius) / apart)) / 2;
  const ExtendedPoint foot = a.point + to_chord * axis;
  if (apart > a.radius + b.radius - slack || apart < inner + slack) {
    const Extended sign = to_chord < 0 ? -1 : 1;
    return {a.point + (sign * a.radius) * axis};
  }
  const Extended square = (a.radius - to_chord) * (a.radius + to_chord);
  if (square <= 0) return {foot};
  const ExtendedPoint across = std::sqrt(square) * left_normal(axis);
  return {foot - across, foot + across};
}

}  // namespace

ExtendedPoint operator+(const ExtendedPoint& a, const ExtendedPoint& b) {
  return {a.x + b.x, a.y + b.y};
}
ExtendedPoint operator-(const ExtendedPoint& a, const ExtendedPoint& b) {
  return {a.x - b.x, a.y - b.y};
}
ExtendedPoint operator*(Extended factor, const ExtendedPoint& a) {
  return {factor * a.x, factor * a.y};
}
Extended dot(const ExtendedPoint& a, const ExtendedPoint& b) { return a.x * b.x + a.y * b.y; }
Extended cross(const ExtendedPoint& a, const ExtendedPoint& b) { return a.x * b.y - a.y * b.x; }
Extended length(const ExtendedPoint& a) { return std::sqrt(a.x * a.x + a.y * a.y); }
ExtendedPoint left_normal(const ExtendedPoint& a) { return {-a.y, a.x}; }

std::vector<ExtendedPoint> common_points(const Carrier& a, const Carrier& b, Extended slack) {
  if (!a.round && !b.round) return line_and_line(a, b);
  if (a.round && b.round) return circle_and_circle(a, b, slack);
  return a.round ? line_and_circle(b, a, slack) : line_and_circle(a, b, slack);
}

ExtendedPoint Shape::at(Extended way) const {
  if (!carrier.round) return start + way * carrier.along;
  if (carrier.radius == 0) return start;
  const Extended angle = (sweep < 0 ? -way : way) / carrier.radius;
  const ExtendedPoint spoke = start - carrier.point;
  return carrier.point + std::cos(angle) * spoke + std::sin(angle) * left_normal(spoke);
}

Extended Shape::way_to(const ExtendedPoint& point) const {
  if (!carrier.round) return dot(point - start, carrier.along);
  const ExtendedPoint from = start - carrier.point;
  const ExtendedPoint to = point - carrier.point;
  Extended angle = std::atan2(cross(from, to), dot(from, to));
  if (sweep < 0) angle = -angle;
  if (angle < 0) angle += 2 * pi;
  // Half of what the arc leaves open belongs to its start, half to its end.
  const Extended open = 2 * pi - std::abs(sweep);
  if (angle > std::abs(sweep) + open / 2) angle -= 2 * pi;
  return angle * carrier.radius;
}

ExtendedPoint Shape::heading(Extended way) const {
  if (!carrier.round) return carrier.along;
  const ExtendedPoint spoke = at(way) - carrier.point;
  const Extended size = length(spoke);
  if (size == 0) return {};
  return ((sweep < 0 ? -1 : 1) / size) * left_normal(spoke);
}

Extended Shape::distance_to(const ExtendedPoint& point) const {
  if (!carrier.round) {
    const Extended way = std::clamp(dot(point - start, carrier.along), 0.0L, extent);
    return length(point - at(way));
  }
  const Extended to_ends = std::min(length(point - start), length(point - end));
  const Extended way = way_to(point);
  if (way < 0 || way > extent) return to_ends;
  return std::min(to_ends, std::abs(length(point - carrier.point) - carrier.radius));
}

Shape line_shape(const ExtendedPoint& start, const ExtendedPoint& end) {
  const Extended extent = length(end - start);
  const ExtendedPoint along = extent > 0 ? (1 / extent) * (end - start) : ExtendedPoint{1, 0};
  return {.carrier = {.round = false, .point = start, .along = along, .radius = 0},
          .start = start,
          .end = end,
          .sweep = 0,
          .extent = extent};
}

Shape arc_shape(const ExtendedPoint& center, const ExtendedPoint& start, Extended sweep) {
  Shape arc{
      .carrier = {.round = true, .point = center, .along = {}, .radius = length(start - center)},
      .start = start,
      .end = start,
      .sweep = sweep,
      .extent = 0};
  arc.extent = std::abs(sweep) * arc.carrier.radius;
  arc.end = arc.at(arc.extent);
  return arc;
}

Shape shape_of(const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment))
    return line_shape(wide(line->start), wide(line->end));
  const auto& arc = std::get<Arc>(segment);
  const ExtendedPoint center = wide(arc.center);
  const ExtendedPoint from = wide(arc.start) - center;
  const ExtendedPoint to = wide(arc.end) - center;
  // The ends tell the sweep better than the rounded number does.
  const Extended turn = std::atan2(cross(from, to), dot(from, to));
  const Extended turns = std::round((arc.sweep - turn) / (2 * pi));
  const Extended sweep = turn + 2 * pi * turns;
  Shape shape = arc_shape(center, wide(arc.start), sweep);
  shape.end = wide(arc.end);
  return shape;
}

Segment segment_of(const Shape& shape) {
  if (!shape.carrier.round) return Line{.start = narrow(shape.start), .end = narrow(shape.end)};
  return Arc{.start = narrow(shape.start),
             .end = narrow(shape.end),
             .center = narrow(shape.carrier.point),
             .sweep = static_cast<double>(shape.sweep)};
}

Extended distance(const Shape& a, const Shape& b) {
  for (const ExtendedPoint& point : common_points(a.carrier, b.carrier, 0)) {
    const Extended on_a = a.way_to(point);
    const Extended on_b = b.way_to(point);
    if (on_a >= 0 && on_a <= a.extent && on_b >= 0 && on_b <= b.extent) return 0;
  }
  Extended least = std::min(
      {b.distance_to(a.start), b.distance_to(a.end), a.distance_to(b.start), a.distance_to(b.end)});
  // Between the ends the shortest connection stands square on both.
  const auto try_square = [&](const Shape& on, const Shape& other) {
    if (!other.carrier.round) return;
    const auto look = [&](const ExtendedPoint& point) {
      const Extended way = on.way_to(point);
      if (way >= 0 && way <= on.extent) least = std::min(least, other.distance_to(point));
    };
    const ExtendedPoint& center = other.carrier.point;
    if (!on.carrier.round) {
      look(on.start + dot(center - on.start, on.carrier.along) * on.carrier.along);
      return;
    }
    const ExtendedPoint between = center - on.carrier.point;
    const Extended apart = length(between);
    if (apart == 0) return;
    look(on.carrier.point + (on.carrier.radius / apart) * between);
    look(on.carrier.point - (on.carrier.radius / apart) * between);
  };
  try_square(a, b);
  try_square(b, a);
  return least;
}

LeastDistance least_distance(std::span<const Segment> path, std::span<const Segment> contour) {
  std::vector<Shape> blocks;
  for (const Segment& block : contour) blocks.push_back(shape_of(block));
  LeastDistance best{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Shape piece = shape_of(path[k]);
    for (std::size_t j = 0; j < blocks.size(); ++j) {
      const auto here = static_cast<double>(distance(piece, blocks[j]));
      if (here < best.distance) best = {.distance = here, .path_block = k, .contour_block = j};
    }
  }
  return best;
}

double hausdorff(std::span<const Segment> a, std::span<const Segment> b) {
  const auto one_way = [](std::span<const Segment> from, std::span<const Segment> to) {
    std::vector<Shape> targets;
    for (const Segment& segment : to) targets.push_back(shape_of(segment));
    Extended worst = 0;
    for (const Segment& segment : from) {
      const Shape shape = shape_of(segment);
      for (int k = 0; k <= points_between + 1; ++k) {
        const ExtendedPoint point = shape.at(shape.extent * k / (points_between + 1));
        Extended nearest = std::numeric_limits<Extended>::infinity();
        for (const Shape& target : targets) {
          nearest = std::min(nearest, target.distance_to(point));
          if (nearest <= worst) break;
        }
        worst = std::max(worst, nearest);
      }
    }
    return static_cast<double>(worst);
  };
  return std::max(one_way(a, b), one_way(b, a));
}

}  // namespace trc::support
