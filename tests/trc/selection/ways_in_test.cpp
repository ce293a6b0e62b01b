#include <gtest/gtest.h>

#include <numbers>

#include "core/trc/selection/direct.h"
#include "core/trc/selection/on_path.h"
#include "core/trc/selection/tangential.h"
#include "tests/trc/passes/given_blocks.h"

// How each selection mode brings the tool to the equidistant. The tool is left of the contour.

namespace trc::selection {
namespace {

using support::expect_point;

constexpr double pi = std::numbers::pi;

// From the selection block along the first axis onto a contour in that direction.
Corner corner_into(const Vector& contour, double radius) {
  Corner corner;
  corner.shift = radius;
  corner.before = {.anchor = {0, radius}, .tangent = {1, 0}};
  corner.after = {.anchor = radius * left_of(contour), .tangent = contour};
  return corner;
}

const Line selection_block{.start = {-20, 0}, .end = {0, 0}};

TEST(DirectSelection, GoesStraightToThePerpendicularPoint) {  // rule 3.1
  const Joint joint = approach_direct(corner_into({0, 1}, 5));
  expect_point(joint.end, -5, 0);
  EXPECT_EQ(joint.end, joint.start);
}

TEST(SelectionOnPath, GoesRoundTheCornerByAnArc) {  // rule 3.3
  const auto joint = approach_on_path(corner_into({0, -1}, 5), selection_block, {1, 0},
                                      AroundCorner::arc, Tolerances{});
  ASSERT_TRUE(joint);
  expect_point(joint->end, -5, 0);
  expect_point(joint->start, 5, 0);
  EXPECT_NEAR(joint->cut_before, 5, 1e-12);
  ASSERT_EQ(joint->inserted().size(), 1U);
  const auto* around = std::get_if<Arc>(&*joint->inserted().front());
  ASSERT_NE(around, nullptr);
  expect_point(around->center, 0, 0);
  EXPECT_NEAR(around->sweep, -pi, 1e-12);
}

TEST(SelectionOnPath, ChangesOverWhereThePathCrossesTheEquidistant) {  // rule 3.3
  // Back at 45 degrees: the equidistant crosses the block 5 · sqrt(2) before the corner.
  const Vector back = Vector(-1, 1).normalized();
  const auto joint = approach_on_path(corner_into(back, 5), selection_block, {1, 0},
                                      AroundCorner::arc, Tolerances{});
  ASSERT_TRUE(joint);
  expect_point(joint->end, -5 * std::numbers::sqrt2, 0);
  EXPECT_TRUE(joint->inserted().empty());
}

TEST(SelectionOnPath, NeedsABlockAsLongAsItTakes) {  // D-03
  const Line too_short{.start = {-4, 0}, .end = {0, 0}};
  const Corner corner = corner_into({0, -1}, 5);
  EXPECT_FALSE(approach_on_path(corner, too_short, {1, 0}, AroundCorner::arc, Tolerances{}));
  const auto needed = needed_on_path(corner, too_short, {1, 0}, AroundCorner::arc, Tolerances{});
  ASSERT_TRUE(needed);
  EXPECT_NEAR(*needed, 5, 1e-12);
}

// The rounding of a difference decides nothing.
TEST(SelectionOnPath, TakesABlockAsLongAsTheRadiusWithinATenthOfAMicrometre) {  // D-14
  const Corner corner = corner_into({0, -1}, 5);
  for (const double more : {-9e-5, -1e-12, 0.0, 1e-12, 9e-5}) {
    const Line block{.start = {-5 - more, 0}, .end = {0, 0}};
    const auto joint = approach_on_path(corner, block, {1, 0}, AroundCorner::arc, Tolerances{});
    ASSERT_TRUE(joint) << more;
    EXPECT_EQ(joint->end, block.start);
    EXPECT_EQ(joint->cut_before, length_of(block));
  }
  const Line shorter{.start = {-4.9998, 0}, .end = {0, 0}};
  EXPECT_FALSE(approach_on_path(corner, shorter, {1, 0}, AroundCorner::arc, Tolerances{}));
}

TEST(TangentialSelection, RunsIntoTheContourByAnArc) {  // rule 3.7
  const auto way = tangential_entry({-5, 5}, {0, 0}, {1, 0}, Tolerances{});
  ASSERT_TRUE(way);
  const auto* arc = std::get_if<Arc>(&*way);
  ASSERT_NE(arc, nullptr);
  expect_point(arc->center, 0, 5);
  EXPECT_NEAR(arc->sweep, pi / 2, 1e-12);
}

TEST(TangentialSelection, IsALineFromBehindAndNoneFromAhead) {  // D-04
  const auto from_behind = tangential_entry({-5, 0}, {0, 0}, {1, 0}, Tolerances{});
  ASSERT_TRUE(from_behind);
  EXPECT_FALSE(is_arc(*from_behind));
  EXPECT_FALSE(tangential_entry({5, 0}, {0, 0}, {1, 0}, Tolerances{}));
}

TEST(TangentialDeselection, LeavesTheContourByAnArc) {
  const auto way = tangential_exit({0, 0}, {1, 0}, {5, -5}, Tolerances{});
  ASSERT_TRUE(way);
  const auto* arc = std::get_if<Arc>(&*way);
  ASSERT_NE(arc, nullptr);
  expect_point(arc->center, 0, -5);
  EXPECT_NEAR(arc->sweep, -pi / 2, 1e-12);
}

}  // namespace
}  // namespace trc::selection
