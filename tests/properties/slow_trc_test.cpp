#include "tests/support/slow_trc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/slow_clearance.h"

// The judge is judged first: by the worked examples of the rule book.

namespace trc::support {
namespace {

Contour of_lines(const std::vector<Point>& points) {
  Contour contour;
  contour.approach = {.start = points[0], .end = points[1]};
  for (std::size_t k = 1; k + 2 < points.size(); ++k)
    contour.blocks.emplace_back(Line{.start = points[k], .end = points[k + 1]});
  contour.retract = {.start = points[points.size() - 2], .end = points.back()};
  return contour;
}

void expect_point(const SlowPoint& point, double x, double y) {
  EXPECT_NEAR(static_cast<double>(point.x), x, 1e-4);
  EXPECT_NEAR(static_cast<double>(point.y), y, 1e-4);
}

TrcMode left_of_contour(double radius, Selection selection) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = radius;
  mode.selection = selection;
  return mode;
}

TEST(SlowTrc, FindsTheG239Demo) {  // T-01
  const Contour contour = of_lines({{0, 0}, {30, 20}, {60, 20}, {90, 20}, {120, 20}, {150, 0}});
  const SlowOutcome outcome = slow_trc(contour, left_of_contour(10, Selection::without_block));
  ASSERT_TRUE(outcome.faults.empty());
  ASSERT_EQ(outcome.path.size(), 5U);
  expect_point(outcome.path[0].end, 30, 30);
  expect_point(outcome.path[1].end, 60, 30);
  expect_point(outcome.path[3].end, 120, 30);
  expect_point(outcome.path[4].end, 150, 0);
}

TEST(SlowTrc, StretchesTheCornersOfT09) {
  const Contour contour = of_lines({{0, 0}, {10, 20}, {35, 30}, {30, 20}, {30, 10}, {20, 0}});
  TrcMode mode = left_of_contour(5, Selection::indirect);
  SlowOutcome outcome = slow_trc(contour, mode);
  ASSERT_EQ(outcome.path.size(), 6U);
  expect_point(outcome.path[0].end, 6.3780, 23.9364);
  expect_point(outcome.path[1].end, 37.7854, 36.4993);
  EXPECT_EQ(outcome.path[2].origin, Origin::transition);
  expect_point(outcome.path[2].end, 41.7082, 32.2361);
  expect_point(outcome.path[3].end, 35, 18.8197);
  expect_point(outcome.path[4].end, 35, 7.9289);
  expect_point(outcome.path[5].end, 20, 0);

  mode.options.stretch_factor = 3;
  outcome = slow_trc(contour, mode);
  ASSERT_EQ(outcome.path.size(), 5U);
  expect_point(outcome.path[1].end, 45.3534, 39.5265);

  mode.transition = Transition::circular;
  outcome = slow_trc(contour, mode);
  ASSERT_TRUE(outcome.path[3].is_arc);
  expect_point(outcome.path[3].start, 33.1430, 34.6424);
  expect_point(outcome.path[3].end, 39.4721, 27.7639);
  EXPECT_LT(outcome.path[3].sweep, 0);
}

TEST(SlowTrc, TrimsAnArcInAnInsideCorner) {  // the corner of T-07
  Contour contour;
  contour.approach = {.start = {60, 40}, .end = {60, 60}};
  contour.blocks.emplace_back(Line{.start = {60, 60}, .end = {60, 100}});
  contour.blocks.emplace_back(Arc{
      .start = {60, 100}, .end = {10, 150}, .center = {60, 150}, .sweep = 1.5 * 3.14159265358979});
  contour.retract = {.start = {10, 150}, .end = {10, 100}};
  TrcMode mode = left_of_contour(5, Selection::direct);
  mode.side = Side::right;
  const SlowOutcome outcome = slow_trc(contour, mode);
  ASSERT_TRUE(outcome.faults.empty());
  expect_point(outcome.path[1].end, 65, 95.2277);
  expect_point(outcome.path[2].end, 5, 150);
}

TEST(SlowTrc, NamesTheReversedLineAndTheWrappedArcOfT17) {
  const SlowOutcome line =
      slow_trc(of_lines({{-30, 0}, {0, 0}, {50, 0}, {55, 5}, {55, 50}, {55, 80}}),
               left_of_contour(10, Selection::indirect));
  ASSERT_EQ(line.faults.size(), 1U);
  EXPECT_EQ(line.faults[0].code, Code::line_reversed);
  EXPECT_EQ(line.faults[0].ordinal, 2U);

  Contour contour =
      of_lines({{-30, 0}, {0, 0}, {50, 0}, {54.3923, 4.3923}, {54.3923, 50}, {54, 80}});
  const Point center{44, 10.392304845413264};
  const double half = std::sqrt(3.0) / 2;
  const Point end = center + 12 * Point(half, -0.5);
  contour.blocks[1] =
      Arc{.start = {50, 0}, .end = end, .center = center, .sweep = 3.14159265358979 / 6};
  contour.blocks[2] = Line{.start = end, .end = {end.x(), 50}};
  const SlowOutcome arc = slow_trc(contour, left_of_contour(10, Selection::indirect));
  ASSERT_EQ(arc.faults.size(), 1U);
  EXPECT_EQ(arc.faults[0].code, Code::arc_wrapped);
  EXPECT_EQ(arc.faults[0].ordinal, 2U);

  const SlowOutcome swallowed = slow_trc(contour, left_of_contour(12.5, Selection::indirect));
  ASSERT_FALSE(swallowed.faults.empty());
  EXPECT_EQ(swallowed.faults[0].code, Code::tool_not_smaller_than_arc);
}

TEST(SlowTrc, SquareWithLineAndArcCornersKeepsItsDistance) {
  const Contour contour =
      of_lines({{-20, 0}, {0, 0}, {40, 0}, {40, -40}, {0, -40}, {0, -20}, {9, 9}});
  for (const Transition transition : {Transition::linear, Transition::circular}) {
    TrcMode mode = left_of_contour(5, Selection::indirect);
    mode.transition = transition;
    const SlowOutcome outcome = slow_trc(contour, mode);
    std::vector<Segment> path;
    for (const SlowBlock& block : outcome.path)
      if (block.origin == Origin::programmed || block.origin == Origin::transition) {
        const Point start{static_cast<double>(block.start.x), static_cast<double>(block.start.y)};
        const Point end{static_cast<double>(block.end.x), static_cast<double>(block.end.y)};
        const Point center{static_cast<double>(block.center.x),
                           static_cast<double>(block.center.y)};
        if (block.is_arc)
          path.emplace_back(Arc{start, end, center, static_cast<double>(block.sweep)});
        else
          path.emplace_back(Line{start, end});
      }
    EXPECT_NEAR(slow_clearance(path, contour.blocks, 0.1).distance, 5, 1e-9);
  }
}

TEST(SlowClearance, SeesASmallGouge) {
  const std::vector<Segment> path{Line{.start = {0, 5}, .end = {100, 4.999}}};
  const std::vector<Segment> contour{Line{.start = {0, 0}, .end = {100, 0}}};
  const SlowClearance clearance = slow_clearance(path, contour, 1);
  EXPECT_NEAR(clearance.distance, 4.999, 1e-9);
  EXPECT_NEAR(clearance.where.x(), 100, 1e-9);
}

TEST(SlowClearance, MeasuresFromTheEndsOfAnArc) {
  const Arc half{.start = {10, 0}, .end = {-10, 0}, .center = {0, 0}, .sweep = 3.14159265358979};
  EXPECT_DOUBLE_EQ(slow_distance({0, 12}, half), 2);
  EXPECT_DOUBLE_EQ(slow_distance({10, -3}, half), 3);
  EXPECT_DOUBLE_EQ(slow_distance({0, 0}, half), 10);
}

}  // namespace
}  // namespace trc::support
