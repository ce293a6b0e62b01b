#include <gtest/gtest.h>

#include <numbers>

#include "core/trc/passes/convert_circles.h"
#include "core/trc/passes/kerf_masking.h"
#include "core/trc/passes/rounded_input.h"
#include "tests/trc/passes/given_blocks.h"

// The passes that change the programmed contour, each alone.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

// Counter-clockwise about the zero point, from the first axis on.
Arc arc(double radius, double sweep) {
  return {.start = {radius, 0},
          .end = {radius * std::cos(sweep), radius * std::sin(sweep)},
          .center = Point::Zero(),
          .sweep = sweep};
}

TrcMode converting_mode(double radius) {
  TrcMode mode = left_of_contour(radius);
  mode.masking = Masking::on;
  mode.options.conv_cir_to_lin = true;
  return mode;
}

TEST(ConvertCirclesPass, MakesAChordOfAnArcThatIsSmallerThanTheTool) {
  const PathBlockPtr block = contour_block(arc(1, pi / 2), converting_mode(2));
  ASSERT_TRUE(ConvertCircles(Tolerances{}).apply(*block));
  ASSERT_TRUE(std::holds_alternative<Line>(block->programmed.path));
  expect_point(start_of(block->programmed.path), 1, 0);
  expect_point(end_of(block->programmed.path), 0, 1);
  EXPECT_EQ(block->origin, Origin::converted_circle);
}

TEST(ConvertCirclesPass, LeavesAnArcAsLargeAsTheToolAndAFullCircle) {  // D-18
  const PathBlockPtr as_large = contour_block(arc(2, pi / 2), converting_mode(2));
  ASSERT_TRUE(ConvertCircles(Tolerances{}).apply(*as_large));
  EXPECT_TRUE(is_arc(as_large->programmed.path));

  Arc full = arc(1, 2 * pi);
  full.end = full.start;
  const PathBlockPtr circle = contour_block(full, converting_mode(2));
  ASSERT_TRUE(ConvertCircles(Tolerances{}).apply(*circle));
  EXPECT_TRUE(is_arc(circle->programmed.path));
}

// A notch 6 wide and 4 deep. The tool of radius R in it touches a flank R · 4/3 above the bottom.
PathBlocks notch_for(double radius) {
  TrcMode mode = left_of_contour(radius);
  mode.options.kerf_masking = true;
  return in_a_row(contour_block(Line{.start = {-3, 4}, .end = {0, 0}}, mode),
                  contour_block(Line{.start = {0, 0}, .end = {3, 4}}, mode));
}

TEST(KerfMaskingPass, RaisesTheBottomOfANotchUntilTheCornersLeaveNothingOfItsFlanks) {  // D-16
  KerfMasking pass(true, Tolerances{});
  const PathBlocks out = all_from(pass, notch_for(5));
  ASSERT_EQ(out.size(), 2U);
  // The flanks are sqrt(9 + u²) long then, u being how deep it still is, and 5 u / 3.
  expect_point(end_of(out[0]->programmed.path), 0, 4 - 2.25);
  EXPECT_EQ(end_of(out[0]->programmed.path), start_of(out[1]->programmed.path));
  EXPECT_EQ(out[0]->origin, Origin::kerf);
}

TEST(KerfMaskingPass, LeavesANotchTheToolCanEnter) {
  KerfMasking pass(true, Tolerances{});
  const PathBlocks out = all_from(pass, notch_for(3.7));
  ASSERT_EQ(out.size(), 2U);
  expect_point(end_of(out[0]->programmed.path), 0, 0);
  EXPECT_EQ(out[0]->origin, Origin::programmed);
}

TEST(RoundedInputPass, LetsLongLinesPassAtOnce) {
  RoundedInput pass(0.001, Tolerances{});
  const PathBlockPtr block =
      contour_block(Line{.start = {0, 0}, .end = {10, 0}}, left_of_contour(2));
  EXPECT_TRUE(pass.ignores(*block));
}

}  // namespace
}  // namespace trc::support
