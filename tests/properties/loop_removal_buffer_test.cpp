#include <geos_c.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/big_contours.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"
#include "tests/support/slow_shapes.h"

// Loop removal on simple closed contours of many blocks against the buffer of GEOS,
// which knows polygons only: both have to give the same boundary.

namespace trc::support {
namespace {

using Context = std::remove_pointer_t<GEOSContextHandle_t>;

// Geometries of one GEOS context, each let go of at its end.
class Geos {
 public:
  using Geometry = std::unique_ptr<GEOSGeometry, std::function<void(GEOSGeometry*)>>;
  using Prepared =
      std::unique_ptr<const GEOSPreparedGeometry, std::function<void(const GEOSPreparedGeometry*)>>;

  Geometry line(const std::vector<Point>& points) {
    return own(GEOSGeom_createLineString_r(handle(), sequence(points)));
  }
  Geometry point(const Point& at) {
    return own(GEOSGeom_createPointFromXY_r(handle(), at.x(), at.y()));
  }
  Geometry polygon(const std::vector<Point>& ring) {
    GEOSGeometry* shell = GEOSGeom_createLinearRing_r(handle(), sequence(ring));
    return own(GEOSGeom_createPolygon_r(handle(), shell, nullptr, 0));
  }
  Geometry buffer(const Geometry& of, double width, int segments_a_quadrant) {
    return own(GEOSBuffer_r(handle(), of.get(), width, segments_a_quadrant));
  }
  Prepared prepared(const Geometry& of) {
    return {GEOSPrepare_r(handle(), of.get()), [this](const GEOSPreparedGeometry* geometry) {
              GEOSPreparedGeom_destroy_r(handle(), geometry);
            }};
  }

  // Outlines and holes of a polygon or of several.
  std::vector<std::vector<Point>> rings(const Geometry& of) {
    std::vector<std::vector<Point>> result;
    for (int k = 0; k < GEOSGetNumGeometries_r(handle(), of.get()); ++k) {
      const GEOSGeometry* polygon = GEOSGetGeometryN_r(handle(), of.get(), k);
      if (GEOSisEmpty_r(handle(), polygon) != 0) continue;
      result.push_back(points(GEOSGetExteriorRing_r(handle(), polygon)));
      for (int hole = 0; hole < GEOSGetNumInteriorRings_r(handle(), polygon); ++hole)
        result.push_back(points(GEOSGetInteriorRingN_r(handle(), polygon, hole)));
    }
    return result;
  }
  double distance(const Prepared& to, const Point& from) {
    double result = 0;
    GEOSPreparedDistance_r(handle(), to.get(), point(from).get(), &result);
    return result;
  }

 private:
  [[nodiscard]] GEOSContextHandle_t handle() const { return context_.get(); }
  Geometry own(GEOSGeometry* geometry) {
    return {geometry, [this](GEOSGeometry* old) { GEOSGeom_destroy_r(handle(), old); }};
  }
  GEOSCoordSequence* sequence(const std::vector<Point>& points) {
    GEOSCoordSequence* result =
        GEOSCoordSeq_create_r(handle(), static_cast<unsigned>(points.size()), 2);
    for (unsigned k = 0; k < points.size(); ++k)
      GEOSCoordSeq_setXY_r(handle(), result, k, points[k].x(), points[k].y());
    return result;
  }
  std::vector<Point> points(const GEOSGeometry* ring) {
    const GEOSCoordSequence* coordinates = GEOSGeom_getCoordSeq_r(handle(), ring);
    unsigned count = 0;
    GEOSCoordSeq_getSize_r(handle(), coordinates, &count);
    std::vector<Point> result(count);
    for (unsigned k = 0; k < count; ++k)
      GEOSCoordSeq_getXY_r(handle(), coordinates, k, &result[k].x(), &result[k].y());
    return result;
  }

  std::unique_ptr<Context, decltype(&GEOS_finish_r)> context_{GEOS_init_r(), &GEOS_finish_r};
};

// Points along a path, the first one again at the end; arcs in chords that are off by
// at most `error` mm.
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

double area_within(const std::vector<Point>& ring) {
  double twice = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const Vector a = ring[k] - ring.front();
    const Vector b = ring[k + 1] - ring.front();
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

double length_of_ring(const std::vector<Point>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) sum += (ring[k + 1] - ring[k]).norm();
  return sum;
}

// The contour, begun within a block where the tool has room, if there is one.
std::optional<std::vector<Segment>> begun_legally(const std::vector<Segment>& contour,
                                                  const TrcMode& mode) {
  const double shift = mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
  for (std::size_t first = 0; first < contour.size(); ++first) {
    const Vector ahead = point_at(contour[first], 0.51) - point_at(contour[first], 0.49);
    const Point tool =
        point_at(contour[first], 0.5) + shift * Vector(-ahead.y(), ahead.x()).normalized();
    const bool room = std::all_of(contour.begin(), contour.end(), [&](const Segment& block) {
      return slow_distance(tool, block) >= mode.tool_radius * (1 - 1e-9);
    });
    if (room) return begun_within(contour, first);
  }
  return std::nullopt;
}

class Buffer : public ::testing::TestWithParam<std::tuple<BigShape, Side>> {};

TEST_P(Buffer, HasTheSameBoundary) {
  const auto [shape, side] = GetParam();
  Geos geos;
  std::size_t compared = 0;
  for (const std::size_t blocks : {std::size_t{400}, std::size_t{2000}})
    for (const double radius : {0.4, 0.6, 1.0, 3.0, 5.0, 50.0}) {
      SCOPED_TRACE(std::to_string(blocks) + " blocks, R " + std::to_string(radius));
      TrcMode mode;
      mode.side = side;
      mode.tool_radius = radius;
      mode.selection = mode.deselection = Selection::direct;
      mode.transition = Transition::circular;
      mode.masking = Masking::on;
      mode.options.remove_masked_blocks = true;
      const auto whole = big_contour(shape, blocks);
      // The chords of GEOS are off by 0.0003 R; what it leaves out of its raw curve to
      // have it simpler comes on top.
      const double error = 1e-3 * radius;
      // Counter-clockwise, the outside is on the right.
      const double width = side == Side::right ? radius : -radius;
      const auto rings =
          geos.rings(geos.buffer(geos.polygon(points_along(whole, 1e-4 * radius)), width, 32));
      const auto begun = begun_legally(whole, mode);
      if (!begun) continue;

      Contour contour;
      contour.blocks = *begun;
      const Point first = point_at(begun->front(), 0);
      contour.approach = {.start = first + Vector(1000, 300), .end = first};
      contour.retract = {.start = first, .end = first + Vector(1000, -300)};
      const Outcome outcome = compensate(contour, mode, {.batch = 0});
      ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
      std::vector<Segment> path;
      for (const CompensatedBlock& block : moving(outcome.blocks))
        if (block.origin == Origin::programmed || block.origin == Origin::transition)
          path.push_back(block.path);
      ASSERT_FALSE(path.empty());
      const auto found = points_along(path, 1e-4 * radius);

      // Several pieces may be left inside: ours is the one with the first point.
      double best = std::numeric_limits<double>::infinity();
      const std::vector<Point>* expected = nullptr;
      for (const auto& ring : rings) {
        const double off = geos.distance(geos.prepared(geos.line(ring)), found.front());
        if (off < best) {
          best = off;
          expected = &ring;
        }
      }
      ASSERT_NE(expected, nullptr);
      const auto expected_line = geos.line(*expected);
      const auto found_line = geos.line(found);
      const auto near_expected = geos.prepared(expected_line);
      const auto near_found = geos.prepared(found_line);
      double farthest = 0;
      for (const Point& point : found)
        farthest = std::max(farthest, geos.distance(near_expected, point));
      for (const Point& point : *expected)
        farthest = std::max(farthest, geos.distance(near_found, point));
      EXPECT_LE(farthest, error);
      EXPECT_NEAR(area_within(found), area_within(*expected), error * length_of_ring(*expected));
      ++compared;
    }
  EXPECT_GE(compared, 4U);
}

INSTANTIATE_TEST_SUITE_P(LoopRemoval, Buffer,
                         ::testing::Combine(::testing::ValuesIn(all_big_shapes),
                                            ::testing::Values(Side::left, Side::right)),
                         [](const auto& param) {
                           return name_of(std::get<0>(param.param)) +
                                  (std::get<1>(param.param) == Side::left ? "Inside" : "Outside");
                         });

}  // namespace
}  // namespace trc::support
