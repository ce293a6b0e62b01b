#include "core/trc/loops/loop_exit.h"

#include <gtest/gtest.h>

#include "tests/trc/loops/loop_room.h"

// Where the path goes on behind a loop.

namespace trc {
namespace {

class LoopExitTest : public LoopRoom {
 protected:
  void expect_at_crossing(const std::optional<LoopExit>& exit) {
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->piece, 1U);
    EXPECT_NEAR(exit->leaves, along_first_, 1e-9);
    EXPECT_EQ(exit->continues.block, 5U);
    EXPECT_NEAR(exit->continues.along, along_second_, 1e-9);
    EXPECT_NEAR(exit->point.x(), crossing_.x(), 1e-9);
    EXPECT_NEAR(exit->point.y(), crossing_.y(), 1e-9);
  }

  LoopExits exits_{path_, walked_, obstacles_, tolerances_, checkpoint_};
};

TEST_F(LoopExitTest, ThePathCrossesItsOtherSideWhereItComesTooNear) {
  hold_narrow_slot();
  walked_.add_whole(0);
  const auto onset = obstacles_.onset(1, 0, std::numbers::pi / 2, Nearness::exact);
  ASSERT_TRUE(onset);
  EXPECT_EQ(onset->obstacle, 3U);
  EXPECT_NEAR(onset->along, along_first_, 1e-6);
  expect_at_crossing(exits_.find({.block = 1, .start = {10, 1}}, *onset, Nearness::exact));
}

TEST_F(LoopExitTest, ACrossingBehindThePlaceIsFoundAgain) {
  hold_narrow_slot();
  walked_.add_whole(0);
  walked_.add_whole(1);
  const PathPiece down{.block = 2, .start = {11, 0}};
  expect_at_crossing(exits_.find(down, {.along = 0, .obstacle = 3}, Nearness::passable));
}

TEST_F(LoopExitTest, BlocksSideBySideAreLeftWhereTheyAre) {
  // The way back lies on the way there: both paths run along y = 1, one radius from either.
  hold(Line{.start = {0, 0}, .end = {10, 0}}, Line{.start = {0, 1}, .end = {10, 1}});
  hold(Line{.start = {10, 0}, .end = {10, 2}}, Line{.start = {9, 1}, .end = {9, 1}});
  hold(Line{.start = {10, 2}, .end = {0, 2}}, Line{.start = {9, 1}, .end = {0, 1}});
  const auto exit =
      exits_.find({.block = 0, .start = {0, 1}}, {.along = 4, .obstacle = 2}, Nearness::passable);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->piece, walked_.end());
  EXPECT_EQ(exit->leaves, 4);
  EXPECT_EQ(exit->continues.block, 2U);
  EXPECT_NEAR(exit->continues.along, 5, 1e-9) << "from x = 9 back to x = 4";
}

TEST_F(LoopExitTest, WithoutACrossingBeforeThePlaceNothingLeadsOn) {
  hold_hook();
  EXPECT_FALSE(
      exits_.find({.block = 0, .start = {0, 1}}, {.along = 5, .obstacle = 3}, Nearness::exact));
}

}  // namespace
}  // namespace trc
