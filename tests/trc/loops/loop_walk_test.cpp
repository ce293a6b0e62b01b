#include "core/trc/loops/loop_walk.h"

#include <gtest/gtest.h>

#include "tests/trc/loops/loop_room.h"

// Which parts of a path are travelled.

namespace trc {
namespace {

class LoopWalkTest : public LoopRoom {
 protected:
  // Its blocks have come, and the contour has ended.
  bool walk_all() {
    walk_.begin();
    walk_.end_contour();
    return walk_.go_on();
  }

  CompensatorSetup setup_{};
  Diagnostics diagnostics_;
  ClosingWatch closing_{setup_.leads, 0};
  LoopWalk walk_{setup_, {path_, obstacles_, walked_, closing_}, diagnostics_, checkpoint_};
};

TEST_F(LoopWalkTest, ASlotAsWideAsTheToolNeedsIsTravelled) {
  hold_slot(3);
  ASSERT_TRUE(walk_all());
  EXPECT_EQ(walked_.end(), 7U);
  EXPECT_EQ(walked_.whole_in_a_row(0, 7), 7U);
  EXPECT_EQ(walk_.at().block, path_.end());
}

TEST_F(LoopWalkTest, ASlotTooNarrowForTheToolIsLeftOut) {
  hold_narrow_slot();
  ASSERT_TRUE(walk_all());
  ASSERT_EQ(walked_.end(), 4U);
  EXPECT_EQ(walked_.whole_in_a_row(0, 4), 1U);
  const PathPiece in = walked_[1];
  EXPECT_EQ(in.block, 1U);
  EXPECT_EQ(in.from, 0);
  EXPECT_NEAR(in.to, along_first_, 1e-9);
  const PathPiece out = walked_[2];
  EXPECT_EQ(out.block, 5U);
  EXPECT_TRUE(out.behind_loop);
  EXPECT_NEAR(out.from, along_second_, 1e-9);
  EXPECT_NEAR(out.to, std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(in.end, out.start) << "the joint is one point";
  EXPECT_NEAR((out.start - crossing_).norm(), 0, 1e-9);
  // On the first arc the tool turns by 30 degrees from the first axis.
  EXPECT_NEAR(out.arrives.x(), std::sqrt(0.75), 1e-9);
  EXPECT_NEAR(out.arrives.y(), -0.5, 1e-9);
  EXPECT_EQ(walked_[3].block, 6U);
}

TEST_F(LoopWalkTest, WhereNothingLeadsOnTheToolStops) {
  hold_hook();
  EXPECT_FALSE(walk_all());
  ASSERT_EQ(diagnostics_.pending().size(), 1U);
  const Diagnostic& refusal = diagnostics_.pending().front();
  EXPECT_EQ(refusal.code, Code::line_reversed);
  EXPECT_EQ(refusal.source.index, 0U);
  ASSERT_TRUE(refusal.point);
  EXPECT_NEAR(refusal.point->x, 5, 1e-3);
  EXPECT_NEAR(refusal.point->y, 1, 1e-9);
}

TEST_F(LoopWalkTest, IgnoredDamageIsTravelledWithAWarning) {
  TrcMode mode;
  mode.options.ignore_cont_damage = true;
  mode_ = std::make_shared<const TrcMode>(mode);
  hold_hook();
  EXPECT_TRUE(walk_all());
  ASSERT_FALSE(diagnostics_.pending().empty());
  EXPECT_EQ(diagnostics_.pending().front().severity, Severity::warning);
  EXPECT_EQ(walk_.at().block, path_.end());
}

TEST_F(LoopWalkTest, AShortPathInNobodysWayIsTakenAtOnce) {
  hold_slot(3);
  walk_.begin();
  walk_.end_contour();
  EXPECT_TRUE(walk_.go_undisturbed());
  EXPECT_EQ(walked_.end(), 7U);
}

TEST_F(LoopWalkTest, APathInTheWayOfTheContourIsNotTakenAtOnce) {
  hold_narrow_slot();
  walk_.begin();
  walk_.end_contour();
  EXPECT_FALSE(walk_.go_undisturbed());
  EXPECT_TRUE(walked_.empty());
}

TEST_F(LoopWalkTest, SetsOutWhenTheWindowIsFull) {
  CompensatorSetup setup = setup_;
  setup.limits.look_ahead_blocks = 2;
  LoopWalk walk(setup, {path_, obstacles_, walked_, closing_}, diagnostics_, checkpoint_);
  walk.begin();
  hold({{0, 0}, {10, 0}, {20, 0}});
  ASSERT_TRUE(walk.go_on());
  EXPECT_TRUE(walked_.empty());
  hold({{20, 0}, {30, 0}});
  ASSERT_TRUE(walk.go_on());
  EXPECT_EQ(walked_.end(), 2U) << "all blocks but the last, whose corner is not known";
  EXPECT_TRUE(walk.has_had_its_window(0));
  EXPECT_FALSE(walk.has_had_its_window(1));
  walk.end_contour();
  ASSERT_TRUE(walk.go_on());
  EXPECT_EQ(walked_.end(), 3U);
}

}  // namespace
}  // namespace trc
