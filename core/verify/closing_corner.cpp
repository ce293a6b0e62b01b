#include "core/verify/closing_corner.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <variant>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::verify {
namespace {

// Chords of the ring: fine enough to tell its inside from its outside.
std::vector<Point> chords_of(const std::vector<MotionBlock>& blocks) {
  constexpr int chords = 8;  // of an arc
  std::vector<Point> ring;
  for (std::size_t block = 1; block < blocks.size(); ++block) {
    const Segment& path = blocks[block].path;
    ring.push_back(start_of(path));
    if (const auto* arc = std::get_if<Arc>(&path))
      for (int chord = 1; chord < chords; ++chord)
        ring.push_back(arc->center + Eigen::Rotation2Dd(arc->sweep * chord / chords) *
                                         (arc->start - arc->center));
  }
  return ring;
}

// Twice the area, positive if the ring runs counter-clockwise.
double area_of(const std::vector<Point>& ring) {
  double area = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    area += cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
  return area;
}

// Counts the chords that a ray along the first axis crosses.
bool is_within(const std::vector<Point>& ring, const Point& point) {
  bool within = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point& a = ring[k];
    const Point& b = ring[(k + 1) % ring.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    within ^= x > point.x();
  }
  return within;
}

}  // namespace

ClosingCorner closing_corner(const RefusedWay& way, double input_resolution) {
  const Segment& first = way.blocks[1].path;
  const Segment& last = way.blocks.back().path;
  if ((end_of(last) - start_of(first)).norm() > input_resolution) return ClosingCorner::none;
  if (cross(tangent_at_end(last), tangent_at_start(first)) * way.shift <= 0)
    return ClosingCorner::none;
  const std::vector<Point> ring = chords_of(way.blocks);
  const bool cuts_within = area_of(ring) * way.shift > 0;
  const bool comes_from_within = is_within(ring, start_of(way.blocks.front().path));
  return cuts_within == comes_from_within ? ClosingCorner::inside : ClosingCorner::other_side;
}

}  // namespace trc::verify
