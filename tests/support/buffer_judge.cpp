#include "tests/support/buffer_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trc::support {
namespace {

double length_of_ring(const std::vector<Point>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) sum += (ring[k + 1] - ring[k]).norm();
  return sum;
}

}  // namespace

std::vector<Point> points_along(const std::vector<Segment>& path, double error) {
  std::vector<Point> points;
  for (const Segment& segment : path) {
    int parts = 1;
    if (const auto* arc = std::get_if<Arc>(&segment)) {
      const double radius = (arc->start - arc->center).norm();
      const double step = 2 * std::acos(std::clamp(1 - error / std::max(radius, error), -1.0, 1.0));
      parts = std::max(2, static_cast<int>(std::ceil(std::abs(arc->sweep) / step)));
    }
    for (int k = 0; k < parts; ++k)
      points.push_back(point_at(segment, static_cast<double>(k) / parts));
  }
  points.push_back(points.front());
  return points;
}

double signed_area_within(const std::vector<Point>& ring) {
  double twice = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const Vector a = ring[k] - ring.front();
    const Vector b = ring[k + 1] - ring.front();
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

std::optional<PieceLeft> piece_left(Geos& geos, const std::vector<Point>& outline,
                                    const TrcMode& mode, const Point& place) {
  // Counter-clockwise, the outside is on the right.
  const bool outside = (mode.side == Side::right) == (signed_area_within(outline) > 0);
  const double width = outside ? mode.tool_radius : -mode.tool_radius;
  std::optional<PieceLeft> nearest;
  for (auto& ring : geos.rings(geos.buffer(geos.polygon(outline), width, 32))) {
    const double off = geos.distance(geos.prepared(geos.line(ring)), place);
    if (!nearest || off < nearest->off) nearest = PieceLeft{std::move(ring), off};
  }
  return nearest;
}

std::optional<Difference> difference_of(Geos& geos, const std::vector<Point>& outline,
                                        const Outcome& outcome, const TrcMode& mode) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  if (path.empty()) return std::nullopt;
  const auto found = points_along(path, 1e-4 * mode.tool_radius);
  const auto expected = piece_left(geos, outline, mode, found.front());
  if (!expected) return std::nullopt;
  const auto expected_line = geos.line(expected->ring);
  const auto found_line = geos.line(found);
  const auto near_expected = geos.prepared(expected_line);
  const auto near_found = geos.prepared(found_line);
  Difference result;
  for (const Point& point : found)
    result.farthest = std::max(result.farthest, geos.distance(near_expected, point));
  for (const Point& point : expected->ring)
    result.farthest = std::max(result.farthest, geos.distance(near_found, point));
  result.area =
      std::abs(std::abs(signed_area_within(found)) - std::abs(signed_area_within(expected->ring)));
  result.length = length_of_ring(expected->ring);
  return result;
}

}  // namespace trc::support
