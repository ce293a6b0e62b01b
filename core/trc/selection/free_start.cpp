#include "core/trc/selection/free_start.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/distance.h"

namespace trc::selection {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int directions = 48;
constexpr double spread = 1.2;  // ratio of one ring to the next
constexpr int halvings = 16;

}  // namespace

std::optional<Point> FreeStart::find() const {
  std::optional<Place> best = first_ring();
  if (!best) return std::nullopt;
  best = drawn_near(*best);
  double turn = pi / directions;
  for (int halving = 0; halving < halvings; ++halving, turn /= 2)
    for (const double step : {-turn, turn}) *best = turned(*best, step);
  return point_at(*best);
}

FreeStart::Place FreeStart::turned(Place place, double step) const {
  for (int turn = 0; turn < directions; ++turn) {
    const Place beside{.angle = place.angle + step, .distance = place.distance};
    if (!is_free(beside)) break;
    const Place nearer = drawn_near(beside);
    if (!(nearer.distance < place.distance)) break;
    place = nearer;
  }
  return place;
}

std::optional<FreeStart::Place> FreeStart::first_ring() const {
  const Point& given = asked_.way.start;
  const double radius = std::abs(asked_.shift);
  double farthest = 4 * radius;
  for (const MotionBlock& block : asked_.contour)
    farthest = std::max(farthest, 4 * radius + (end_of(block.path) - given).norm());
  double distance = radius / 50;
  while (distance <= farthest) {
    for (int direction = 0; direction < directions; ++direction) {
      checkpoint_.pass();
      const Place place{.angle = 2 * pi * direction / directions, .distance = distance};
      if (is_free(place)) return place;
    }
    distance *= spread;
  }
  return std::nullopt;
}

FreeStart::Place FreeStart::drawn_near(Place place) const {
  double refused = 0;
  for (int halving = 0; halving < halvings; ++halving) {
    checkpoint_.pass();
    const Place nearer{.angle = place.angle, .distance = (refused + place.distance) / 2};
    if (is_free(nearer)) {
      place = nearer;
    } else {
      refused = nearer.distance;
    }
  }
  return place;
}

Point FreeStart::point_at(const Place& place) const {
  const Point point =
      asked_.way.start + place.distance * Vector(std::cos(place.angle), std::sin(place.angle));
  return {std::round(point.x() / asked_.step) * asked_.step,
          std::round(point.y() / asked_.step) * asked_.step};
}

bool FreeStart::is_free(const Point& start) const {
  const double radius = std::abs(asked_.shift);
  if ((start - asked_.way.end).norm() < radius) return false;
  const auto& contour = asked_.contour;
  const bool is_far = std::all_of(contour.begin(), contour.end(), [&](const MotionBlock& block) {
    return distance(start, block.path) >= radius;
  });
  if (!is_far) return false;
  const Vector along = tangent_at_start(contour.front().path);
  const double aside = cross(along, start - asked_.way.end);
  if (asked_.on_tool_side && !(aside * asked_.shift > 0)) return false;
  const Line programmed{.start = start, .end = asked_.way.end};
  const Line way{.start = start, .end = asked_.target};
  const double required = radius - tolerances_.on_contour / 2;
  for (std::size_t number = 0; number < contour.size(); ++number) {
    const Segment& block = contour[number].path;
    const bool is_neighbour = number == 0 || number + 1 == contour.size();
    if (!is_neighbour && meet(programmed, block, tolerances_.same_point)) return false;
    if (nearness(way, block, tolerances_.same_point).distance < required) return false;
  }
  return true;
}

}  // namespace trc::selection
