#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/random.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// KERF_MASKING: the bottom of a notch rises until the tool gets in (D-16, D-17, D-33).

namespace trc::support {
namespace {

TrcMode notch_mode(double radius = 10) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = radius;
  mode.selection = Selection::direct;
  mode.transition = Transition::circular;
  mode.options.kerf_masking = true;
  return mode;
}

// Along y = 0, down into the notch and up again.
Contour notch(const Segment& down, const Segment& up) {
  const Point mouth = start_of(down);
  const Point exit = end_of(up);
  return {.approach = {.start = {mouth.x() - 80, 0}, .end = {mouth.x() - 50, 0}},
          .blocks = {Line{.start = {mouth.x() - 50, 0}, .end = mouth}, down, up,
                     Line{.start = exit, .end = {exit.x() + 50, 0}}},
          .retract = {.start = {exit.x() + 50, 0}, .end = {exit.x() + 80, 0}}};
}

// An arc that bulges into the notch on its way down, and a straight flank up.
Contour notch_with_arc() {
  const Point bottom{0, -20};
  const double sweep = 0.4;
  const Point start{-5, 0};
  const Vector chord = bottom - start;
  const Vector out = left_of(chord).normalized();
  const Point center = 0.5 * (start + bottom) + out * (0.5 * chord.norm() / std::tan(sweep / 2));
  return notch(Arc{.start = start, .end = bottom, .center = center, .sweep = sweep},
               Line{.start = bottom, .end = {5, 0}});
}

double clearance_from(const Outcome& outcome, std::vector<Segment> contour) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin != Origin::approach && block.origin != Origin::retract)
      path.push_back(block.path);
  return slow_clearance(path, contour, 0.05).distance;
}

std::vector<Origin> moved_blocks(const Outcome& outcome) {
  std::vector<Origin> moved;
  for (const CompensatedBlock& block : outcome.blocks)
    if (block.origin == Origin::kerf) moved.push_back(block.origin);
  return moved;
}

TEST(KerfMasking, LetsTheToolPassANotchBesideAnArc) {  // D-16
  const Contour contour = notch_with_arc();
  TrcMode without = notch_mode();
  without.options.kerf_masking = false;
  ASSERT_TRUE(compensate(contour, without).stopped);

  const Outcome outcome = compensate(contour, notch_mode());
  ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
  EXPECT_EQ(first_gap(outcome.blocks), "");
  EXPECT_EQ(moved_blocks(outcome).size(), 2U);
  EXPECT_GE(clearance_from(outcome, {contour.blocks.front(), contour.blocks.back()}), 10 - 1e-6);
}

TEST(KerfMasking, LeavesANotchTheToolCanEnter) {  // D-16
  const Contour wide =
      notch(Line{.start = {-20, 0}, .end = {0, -20}}, Line{.start = {0, -20}, .end = {20, 0}});
  TrcMode without = notch_mode(3);
  without.options.kerf_masking = false;
  const Outcome outcome = compensate(wide, notch_mode(3));
  EXPECT_TRUE(moved_blocks(outcome).empty());
  EXPECT_EQ(difference(outcome.blocks, compensate(wide, without).blocks, Motion{}, 0), "");
}

TEST(KerfMasking, MovesTheBottomNoFartherThanItMust) {  // D-16
  // Both flanks are left with no length: half the opening over the height of the bottom
  // is R over their length.
  const Outcome outcome = compensate(
      notch(Line{.start = {-5, 0}, .end = {0, -20}}, Line{.start = {0, -20}, .end = {5, 0}}),
      notch_mode());
  ASSERT_FALSE(outcome.stopped);
  for (const CompensatedBlock& block : outcome.blocks)
    if (block.origin == Origin::kerf) {
      EXPECT_NEAR(length_of(block.path), 0, 1e-6);
    }
}

TEST(KerfMasking, OfTheOlderMethodActsUnderG141BetweenLinesUpTo90Degrees) {  // D-33
  CompensatorSetup older;
  older.circular_kerf_masking = false;
  TrcMode mode = notch_mode();
  mode.options.kerf_masking = false;
  const Contour sharp =
      notch(Line{.start = {-5, 0}, .end = {0, -20}}, Line{.start = {0, -20}, .end = {5, 0}});
  EXPECT_TRUE(compensate(sharp, mode, {.compensator = older}).stopped);
  mode.masking = Masking::on;
  EXPECT_EQ(moved_blocks(compensate(sharp, mode, {.compensator = older})).size(), 2U);
  EXPECT_TRUE(moved_blocks(compensate(notch_with_arc(), mode, {.compensator = older})).empty());
  // 100 degrees between the flanks.
  const double depth = 5 / std::tan(50 * std::numbers::pi / 180);
  const Contour blunt =
      notch(Line{.start = {-5, 0}, .end = {0, -depth}}, Line{.start = {0, -depth}, .end = {5, 0}});
  EXPECT_TRUE(moved_blocks(compensate(blunt, mode, {.compensator = older})).empty());
  TrcMode newer = notch_mode();
  EXPECT_EQ(moved_blocks(compensate(blunt, newer)).size(), 2U);
}

// The bottom stays in the notch: above its mouth, or beside a flank, the notch would be a peak that
// the tool runs round, on the other side of the part.
TEST(KerfMasking, MakesNoPeakOfANotch) {  // D-16
  const auto arc_to = [](const Point& start, const Point& end, double radius, bool clockwise) {
    const Vector chord = end - start;
    const double height = std::sqrt(radius * radius - chord.squaredNorm() / 4);
    const double sweep = 2 * std::asin(chord.norm() / 2 / radius);
    return Arc{.start = start,
               .end = end,
               .center = 0.5 * (start + end) +
                         (clockwise ? -height : height) * left_of(chord).normalized(),
               .sweep = clockwise ? -sweep : sweep};
  };
  // The arc ends at the mouth of the notch with its whole length beside the other flank.
  const Contour narrow =
      notch(Line{.start = {0, 0}, .end = {3, -12}}, arc_to({3, -12}, {4, 0}, 20, false));
  EXPECT_TRUE(compensate(narrow, notch_mode(4)).stopped);
  // A notch that the tool can enter from above: nothing is raised.
  TrcMode linear = notch_mode(4);
  linear.transition = Transition::linear;
  const Contour smooth =
      notch(Line{.start = {0, 0}, .end = {0, -11}}, arc_to({0, -11}, {12, 0}, 11, true));
  const Outcome outcome = compensate(smooth, linear);
  ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
  EXPECT_TRUE(moved_blocks(outcome).empty());
  EXPECT_GE(clearance_from(outcome, smooth.blocks), 4 - 1e-6);
}

std::vector<Point> points_of(const Segment& segment) {
  constexpr int steps = 48;
  std::vector<Point> points;
  for (int k = 0; k <= steps; ++k) points.push_back(point_at(segment, double(k) / steps));
  return points;
}

bool cross_each_other(const std::vector<Point>& a, const std::vector<Point>& b) {
  const auto side = [](const Point& from, const Point& to, const Point& point) {
    return cross(to - from, point - from);
  };
  for (std::size_t i = 1; i < a.size(); ++i)
    for (std::size_t j = 1; j < b.size(); ++j) {
      if (a[i] == b[j - 1]) continue;
      if (side(a[i - 1], a[i], b[j - 1]) * side(a[i - 1], a[i], b[j]) < 0 &&
          side(b[j - 1], b[j], a[i - 1]) * side(b[j - 1], b[j], a[i]) < 0)
        return true;
    }
  return false;
}

// Rule 7.1: no point of the path is nearer than the tool radius to the blocks beside the notch.
TEST(KerfMasking, KeepsClearOfTheBlocksBesideTheNotch) {
  int raised = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto flank = [&](const Point& start, const Point& end) -> Segment {
      if (random.chance(0.4)) return Line{.start = start, .end = end};
      const double sweep = (random.chance(0.5) ? 1 : -1) * random.between(0.1, 2.8);
      const Vector chord = end - start;
      return Arc{.start = start,
                 .end = end,
                 .center = 0.5 * (start + end) + 0.5 / std::tan(sweep / 2) * left_of(chord),
                 .sweep = sweep};
    };
    const Point bottom(random.between(-6, 6), random.between(-20, -1));
    const Segment down = flank({-random.between(0.5, 6), 0}, bottom);
    const Segment up = flank(bottom, {random.between(0.5, 6), 0});
    std::vector<Point> all = points_of(down);
    const std::vector<Point> of_up = points_of(up);
    if (cross_each_other(all, of_up)) continue;
    all.insert(all.end(), of_up.begin(), of_up.end());
    if (std::ranges::any_of(all, [](const Point& point) { return point.y() > 1e-9; })) continue;

    const double radius = random.between(1, 10);
    TrcMode mode = notch_mode(radius);
    mode.transition = random.chance(0.5) ? Transition::linear : Transition::circular;
    const Contour contour = notch(down, up);
    const Outcome outcome = compensate(contour, mode);
    if (outcome.stopped || moved_blocks(outcome).empty()) continue;
    ++raised;
    EXPECT_EQ(first_gap(outcome.blocks), "");
    EXPECT_GE(clearance_from(outcome, {contour.blocks.front(), contour.blocks.back()}),
              radius - 1e-6);
  }
  EXPECT_GT(raised, 500);
}

}  // namespace
}  // namespace trc::support
