#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/distance.h"
#include "tests/support/on_circle.h"

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;
const Point center(0.3, -0.2);

Point at(double angle, double radius) { return support::on_circle(center, radius, angle); }

Arc arc_from(double angle, double sweep) {
  return {.start = at(angle, 2), .end = at(angle + sweep, 2), .center = center, .sweep = sweep};
}

TEST(Arc, CoversTheDirectionsItSweepsAndNoOthers) {
  for (const double size : {1e-6, 0.3, pi / 2, 3.0, pi, 3.3, 3 * pi / 2, 6.0, 2 * pi - 1e-6})
    for (const double sweep : {size, -size})
      for (double start = -3; start < 3; start += 0.37) {
        const Arc arc = arc_from(start, sweep);
        const double gap = std::copysign(2 * pi, sweep) - sweep;
        for (const double part : {0.01, 0.3, 0.5, 0.8, 0.99})
          for (const double radius : {0.1, 2.0, 50.0}) {
            EXPECT_TRUE(covers(arc, at(start + part * sweep, radius)))
                << "sweep " << sweep << " from " << start << ", " << part;
            EXPECT_FALSE(covers(arc, at(start - part * gap, radius)))
                << "sweep " << sweep << " from " << start << ", " << part << " of the gap";
          }
      }
}

TEST(Arc, FullCircleCoversAllDirections) {
  for (const double sweep : {2 * pi, -2 * pi})
    for (double start = -3; start < 3; start += 0.5) {
      Arc circle = arc_from(start, sweep);
      circle.end = circle.start;
      for (double angle = -3; angle < 4; angle += 0.1) EXPECT_TRUE(covers(circle, at(angle, 1)));
      EXPECT_TRUE(covers(circle, at(start + pi, 1)));
    }
}

}  // namespace
}  // namespace trc
