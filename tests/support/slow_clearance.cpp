#include "tests/support/slow_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/contours.h"

namespace trc::support {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double length(const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment)) return (line->end - line->start).norm();
  const auto& arc = std::get<Arc>(segment);
  return std::abs(arc.sweep) * (arc.start - arc.center).norm();
}

void look(SlowClearance& best, const Point& point, std::size_t path_block,
          std::span<const Segment> contour) {
  for (std::size_t block = 0; block < contour.size(); ++block) {
    const double distance = slow_distance(point, contour[block]);
    if (distance < best.distance) best = {distance, point, path_block, block};
  }
}

}  // namespace

double slow_distance(const Point& point, const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment)) {
    const Vector travel = line->end - line->start;
    const double square = travel.squaredNorm();
    const double t =
        square > 0 ? std::clamp((point - line->start).dot(travel) / square, 0.0, 1.0) : 0;
    return (point - line->start - t * travel).norm();
  }
  const auto& arc = std::get<Arc>(segment);
  const double to_ends = std::min((point - arc.start).norm(), (point - arc.end).norm());
  const Vector from = arc.start - arc.center;
  const Vector to = point - arc.center;
  if (to.norm() == 0) return std::min(to_ends, from.norm());
  const double sense = arc.sweep > 0 ? 1 : -1;
  double angle = sense * std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  if (angle < 0) angle += two_pi;
  return angle <= std::abs(arc.sweep) ? std::abs(to.norm() - from.norm()) : to_ends;
}

SlowClearance slow_clearance(std::span<const Segment> path, std::span<const Segment> contour,
                             double step) {
  SlowClearance best{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t block = 0; block < path.size(); ++block) {
    const double extent = length(path[block]);
    const auto points = static_cast<std::size_t>(std::ceil(extent / step)) + 1;
    SlowClearance here{.distance = std::numeric_limits<double>::infinity()};
    double nearest = 0;
    for (std::size_t k = 0; k <= points; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(points);
      const double before = here.distance;
      look(here, point_at(path[block], t), block, contour);
      if (here.distance < before) nearest = t;
    }
    for (double width = 1.0 / static_cast<double>(points); width * extent > 1e-9; width /= 4) {
      const double middle = nearest;
      for (int k = -4; k <= 4; ++k) {
        const double t = std::clamp(middle + width * k / 4, 0.0, 1.0);
        const double before = here.distance;
        look(here, point_at(path[block], t), block, contour);
        if (here.distance < before) nearest = t;
      }
    }
    if (here.distance < best.distance) best = here;
  }
  return best;
}

}  // namespace trc::support
