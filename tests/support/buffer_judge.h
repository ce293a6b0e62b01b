#pragma once

#include <geos_c.h>

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "tests/support/run.h"

namespace trc::support {

using Context = std::remove_pointer_t<GEOSContextHandle_t>;

// Geometries of one GEOS context, each freed at its end.
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
  bool is_simple(const Geometry& polygon) { return GEOSisValid_r(handle(), polygon.get()) == 1; }
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
  double distance(const Prepared& to, const Geometry& from) {
    double result = 0;
    GEOSPreparedDistance_r(handle(), to.get(), from.get(), &result);
    return result;
  }
  double distance(const Prepared& to, const Point& from) { return distance(to, point(from)); }

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
[[nodiscard]] std::vector<Point> points_along(const std::vector<Segment>& path, double error);

// Of a ring, positive counter-clockwise.
[[nodiscard]] double signed_area_within(const std::vector<Point>& ring);

// What GEOS leaves of a closed contour that is made wider or narrower by the tool radius.
struct PieceLeft {
  std::vector<Point> ring{};
  double off = 0;  // mm, of the place that was asked for
};
// The piece nearest to the place; none where nothing is left.
[[nodiscard]] std::optional<PieceLeft> piece_left(Geos& geos, const std::vector<Point>& outline,
                                                  const TrcMode& mode, const Point& place);

struct Difference {
  double farthest = 0;  // mm, Hausdorff
  double area = 0;      // mm^2
  double length = 0;    // of the boundary of GEOS, mm
};

// Of the path of a closed contour, and the piece of the buffer of GEOS it runs beside: several may
// be left, ours is the one with the first point. Chords are off by at most 1e-4 R.
[[nodiscard]] std::optional<Difference> difference_of(Geos& geos, const std::vector<Point>& outline,
                                                      const Outcome& outcome, const TrcMode& mode);

}  // namespace trc::support
