#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/trc/passes/contour_masking.h"
#include "core/trc/passes/contour_violations.h"
#include "core/trc/passes/offset.h"
#include "core/trc/passes/transitions.h"
#include "tests/trc/passes/given_blocks.h"

// The passes that make the equidistant and judge it, each alone.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

// A quarter, counter-clockwise about the zero point: the tool on the left is inside.
Arc quarter(double radius) {
  return {.start = {radius, 0}, .end = {0, radius}, .center = Point::Zero(), .sweep = pi / 2};
}

TEST(OffsetPass, PutsThePerpendicularPointsOneRadiusToTheSideOfTheTool) {
  Diagnostics diagnostics;
  Offset pass(Tolerances{}, diagnostics);
  TrcMode mode = left_of_contour(2);
  PathBlockPtr block = contour_block(Line{.start = {0, 0}, .end = {10, 0}}, mode);
  ASSERT_TRUE(pass.apply(*block));
  expect_point(block->offset_start, 0, 2);
  expect_point(block->offset_end, 10, 2);

  mode.side = Side::right;
  block = contour_block(Line{.start = {0, 0}, .end = {10, 0}}, mode);
  ASSERT_TRUE(pass.apply(*block));
  expect_point(block->offset_end, 10, -2);

  block = contour_block(quarter(5), left_of_contour(2));
  ASSERT_TRUE(pass.apply(*block));
  expect_point(block->offset_start, 3, 0);
  expect_point(block->offset_end, 0, 3);
}

TEST(OffsetPass, StopsAtAnArcTheToolDoesNotFitIntoAndMasksItUnderG141) {
  Diagnostics diagnostics;
  Offset pass(Tolerances{}, diagnostics);
  TrcMode mode = left_of_contour(2);
  mode.masking = Masking::on;
  const PathBlockPtr masked = contour_block(quarter(2), mode);
  ASSERT_TRUE(pass.apply(*masked));
  EXPECT_TRUE(masked->masked);

  mode.options.remove_masked_blocks = true;
  const PathBlockPtr unreachable = contour_block(quarter(2), mode);
  ASSERT_TRUE(pass.apply(*unreachable));
  EXPECT_TRUE(unreachable->unreachable);
  EXPECT_FALSE(unreachable->masked);

  EXPECT_FALSE(pass.apply(*contour_block(quarter(2), left_of_contour(2))));
  ASSERT_EQ(diagnostics.pending().size(), 1U);
  EXPECT_EQ(diagnostics.pending().back().code, Code::tool_not_smaller_than_arc);
}

// The corners of B, 2 long, take 5 and 5 · tan(13.28°) of it.
TEST(ContourMaskingPass, MasksABlockItsNeighboursLeaveNothingOfAndJoinsThemAnew) {  // D-09
  TrcMode mode = left_of_contour(5);
  mode.masking = Masking::on;
  Diagnostics diagnostics;
  Checkpoint checkpoint({});
  ContourMasking pass({}, diagnostics, checkpoint);
  const PathBlocks out =
      all_from(pass, in_a_row(contour_block(Line{.start = {0, 0}, .end = {20, 0}}, mode),
                              contour_block(Line{.start = {20, 0}, .end = {20, 2}}, mode),
                              contour_block(Line{.start = {20, 2}, .end = {10, 22}}, mode)));
  ASSERT_FALSE(diagnostics.stopped());
  ASSERT_EQ(out.size(), 3U);
  EXPECT_FALSE(out[0]->masked);
  EXPECT_TRUE(out[1]->masked);
  ASSERT_TRUE(out[2]->rejoin);
  // Where y = 5 crosses the line beside (20, 2) – (10, 22).
  expect_point(out[2]->rejoin->point, 18.5 - 2.5 * std::sqrt(5.0), 5);
}

TEST(TransitionsPass, GoesRoundAnOutsideCornerByAnArcAboutIt) {
  const TrcMode mode = left_of_contour(2);
  Diagnostics diagnostics;
  std::optional<RefusedWay> refused;
  Transitions pass(Tolerances{}, diagnostics, refused);
  const PathBlocks out =
      all_from(pass, in_a_row(approach_block({.start = {-10, 0}, .end = {0, 0}}, mode),
                              contour_block(Line{.start = {0, 0}, .end = {10, 0}}, mode),
                              contour_block(Line{.start = {10, 0}, .end = {10, -10}}, mode)));
  ASSERT_EQ(out.size(), 4U);
  expect_point(end_of(out[0]->tool_path), 0, 2);
  expect_point(end_of(out[1]->tool_path), 10, 2);
  EXPECT_EQ(out[2]->origin, Origin::transition);
  const auto* around = std::get_if<Arc>(&out[2]->tool_path);
  ASSERT_NE(around, nullptr);
  expect_point(around->center, 10, 0);
  expect_point(around->end, 12, 0);
  EXPECT_NEAR(around->sweep, -pi / 2, 1e-12);
  expect_point(end_of(out[3]->tool_path), 12, -10);
}

TEST(TransitionsPass, TrimsBothBlocksAtAnInsideCorner) {
  const TrcMode mode = left_of_contour(2);
  Diagnostics diagnostics;
  std::optional<RefusedWay> refused;
  Transitions pass(Tolerances{}, diagnostics, refused);
  const PathBlocks out =
      all_from(pass, in_a_row(approach_block({.start = {-10, 0}, .end = {0, 0}}, mode),
                              contour_block(Line{.start = {0, 0}, .end = {10, 0}}, mode),
                              contour_block(Line{.start = {10, 0}, .end = {10, 10}}, mode)));
  ASSERT_EQ(out.size(), 3U);
  expect_point(end_of(out[1]->tool_path), 8, 2);
  EXPECT_EQ(end_of(out[1]->tool_path), start_of(out[2]->tool_path));
  EXPECT_NEAR(out[1]->cut_at_end, 2, 1e-12);
}

TEST(ContourViolationsPass, StopsAtALineThatRunsBackwards) {
  Diagnostics diagnostics;
  ContourViolations pass(Tolerances{}, diagnostics);
  const PathBlockPtr block =
      contour_block(Line{.start = {0, 0}, .end = {10, 0}}, left_of_contour(2));
  block->tool_path = Line{.start = {2, 2}, .end = {8, 2}};
  EXPECT_TRUE(pass.apply(*block));
  block->tool_path = Line{.start = {8, 2}, .end = {2, 2}};
  EXPECT_FALSE(pass.apply(*block));
  ASSERT_EQ(diagnostics.pending().size(), 1U);
  EXPECT_EQ(diagnostics.pending().back().code, Code::line_reversed);
}

}  // namespace
}  // namespace trc::support
