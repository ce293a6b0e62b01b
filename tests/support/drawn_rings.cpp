#include "tests/support/drawn_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/messages/diagnostic_text.h"
#include "tests/support/slow_clearance.h"
#include "tests/support/slow_shapes.h"

namespace trc::support {
namespace {

Point rounded(const Point& point) {
  return {std::round(1e3 * point.x()) / 1e3, std::round(1e3 * point.y()) / 1e3};
}

// Beside a point of an edge from there to `end`.
Point place_of_tool(const Point& begin, const Point& end, const TrcMode& mode) {
  const Vector along = (end - begin).normalized();
  const double shift = mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
  return begin + shift * Vector(-along.y(), along.x());
}

// The edges it stands beside are as near as the radius, all others farther.
bool has_room(const std::vector<Segment>& edges, const Point& tool, double radius) {
  return std::all_of(edges.begin(), edges.end(), [&](const Segment& edge) {
    return slow_distance(tool, edge) >= radius * (1 - 1e-9);
  });
}

// Of a path with its arcs in chords, mm.
double least_distance_to(Geos& geos, const std::vector<Point>& outline,
                         const std::vector<Segment>& path, double chords_off) {
  const auto walls = geos.line(outline);
  return geos.distance(geos.prepared(walls), geos.line(points_along(path, chords_off)));
}

}  // namespace

std::vector<Segment> begun_with_room(std::vector<Point> ring, const TrcMode& mode) {
  for (Point& point : ring) point = rounded(point);
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  std::vector<Segment> edges;
  for (std::size_t k = 0; k < ring.size(); ++k)
    edges.emplace_back(Line{.start = ring[k], .end = ring[(k + 1) % ring.size()]});
  // Of large rings some edges are tried.
  const std::size_t stride = 1 + ring.size() / 2000;
  for (std::size_t k = 0; k < ring.size(); k += stride) {
    const Point& end = ring[(k + 1) % ring.size()];
    const Vector along = end - ring[k];
    if (along.norm() < 0.01) continue;
    const Point begin = rounded(ring[k] + 0.5 * along);
    if (begin == end || begin == ring[k]) continue;
    // Rounding makes a kink there.
    if (!has_room(edges, place_of_tool(begin, end, mode), mode.tool_radius) ||
        !has_room(edges, place_of_tool(begin, begin + (begin - ring[k]), mode), mode.tool_radius))
      continue;
    std::rotate(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(k), edges.end());
    edges.front() = Line{.start = begin, .end = end};
    edges.emplace_back(Line{.start = ring[k], .end = begin});
    return edges;
  }
  return {};
}

TrcMode mode_of_ring(double radius, Side side, Transition transition) {
  TrcMode mode;
  mode.side = side;
  mode.tool_radius = radius;
  mode.selection = mode.deselection = Selection::direct;
  mode.transition = transition;
  mode.masking = Masking::on;
  mode.options.remove_masked_blocks = true;
  return mode;
}

std::string Tally::text() const {
  return std::to_string(compared) + " compared, " + std::to_string(refused) + " refused, " +
         std::to_string(different) + " different";
}

void judge(Geos& geos, const std::vector<Segment>& edges, const TrcMode& mode, Tally& tally) {
  const double radius = mode.tool_radius;
  const auto outline = points_along(edges, 1e-4 * radius);
  if (!geos.is_simple(geos.polygon(outline))) return;
  Contour contour;
  contour.blocks = edges;
  const Point first = point_at(edges.front(), 0);
  contour.approach = {.start = first + Vector(1000, 300), .end = first};
  contour.retract = {.start = first, .end = first + Vector(1000, -300)};
  const Outcome outcome = compensate(contour, mode, {.batch = 0});
  ++tally.compared;
  if (outcome.stopped) {
    ++tally.refused;
    const auto piece =
        piece_left(geos, outline, mode, place_of_tool(first, end_of(edges.front()), mode));
    EXPECT_FALSE(piece && piece->off < 0.02 * radius)
        << message_of(*outcome.error()) << ", but GEOS leaves a piece of "
        << signed_area_within(piece->ring) << " mm^2, " << piece->off << " mm off\n"
        << contour;
    return;
  }
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  ASSERT_FALSE(path.empty());
  if (edges.size() < 5000)
    EXPECT_GE(least_distance(path, edges).distance, radius - 1e-4) << contour;
  else
    EXPECT_GE(least_distance_to(geos, outline, path, 1e-4 * radius), radius * (1 - 2e-4) - 1e-4);
  if (mode.transition == Transition::linear) return;
  const auto difference = difference_of(geos, outline, outcome, mode);
  // GEOS simplifies what it widens by up to a hundredth of the radius.
  if (!difference || difference->farthest > 0.02 * radius ||
      difference->area > 0.02 * radius * difference->length) {
    ++tally.different;
    std::cout << "different: R " << radius << ", " << (difference ? difference->farthest : -1)
              << " off\n";
  }
}

}  // namespace trc::support
