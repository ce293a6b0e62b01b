#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
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

}  // namespace
}  // namespace trc::support
