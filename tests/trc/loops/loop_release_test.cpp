#include "core/trc/loops/loop_release.h"

#include <gtest/gtest.h>

#include "core/base/diagnostics.h"
#include "tests/trc/loops/loop_room.h"

// How the travelled part of a path comes out, and what is said of the rest. The loop of the slot is
// left out: 11 of its 30 mm of wall.

namespace trc {
namespace {

class LoopReleaseTest : public LoopRoom {
 protected:
  void walk_past_slot() {
    walked_.add_whole(0);
    walked_.add({.block = 1, .to = along_first_, .start = {10, 1}, .end = crossing_});
    walked_.add({.block = 5,
                 .from = along_second_,
                 .to = std::numbers::pi / 2,
                 .start = crossing_,
                 .end = {11, 1},
                 .behind_loop = true});
    walked_.add_whole(6);
  }

  CompensatorSetup setup_{};
  Diagnostics diagnostics_;
  PathBlocks out_;
};

void expect_path(const PathBlock& block, const Point& start, const Point& end) {
  EXPECT_EQ(start_of(block.tool_path), start);
  EXPECT_EQ(end_of(block.tool_path), end);
}

TEST_F(LoopReleaseTest, BlocksComeOutCutToTheirTravelledParts) {
  hold_narrow_slot();
  walk_past_slot();
  LoopRelease release(setup_, path_, walked_, obstacles_, diagnostics_);
  release.begin();
  ASSERT_TRUE(release.check_left_out());
  release.release_to(walked_.end(), out_);
  ASSERT_EQ(out_.size(), 4U);
  expect_path(*out_[0], {0, 1}, {10, 1});
  expect_path(*out_[1], {10, 1}, crossing_);
  expect_path(*out_[2], crossing_, {11, 1});
  expect_path(*out_[3], {11, 1}, {20, 1});
  EXPECT_NEAR(std::get<Arc>(out_[1]->tool_path).sweep, -std::numbers::pi / 6, 1e-9);
  EXPECT_NEAR(std::get<Arc>(out_[2]->tool_path).sweep, -std::numbers::pi / 6, 1e-9);
  EXPECT_EQ(release.next(), 7U);
  EXPECT_TRUE(walked_.empty());
}

TEST_F(LoopReleaseTest, TheBlocksLeftOutAreNoted) {
  hold_narrow_slot();
  walk_past_slot();
  LoopRelease release(setup_, path_, walked_, obstacles_, diagnostics_);
  release.begin();
  release.release_to(walked_.end(), out_);
  ASSERT_EQ(diagnostics_.pending().size(), 1U);
  const Diagnostic& note = diagnostics_.pending().front();
  EXPECT_EQ(note.code, Code::blocks_masked);
  EXPECT_EQ(note.source.index, 1U);
  const auto length = std::ranges::find(note.values, "left_out_length", &DiagnosticValue::name);
  ASSERT_NE(length, note.values.end());
  EXPECT_NEAR(length->value, 11, 1e-9);
  ASSERT_TRUE(note.point);
  EXPECT_EQ(note.point->x, crossing_.x());
  EXPECT_EQ(note.point->y, crossing_.y());
}

TEST_F(LoopReleaseTest, TechnologyOfALoopComesOutWhereItIsLeft) {
  hold(Line{.start = {-9, 0}, .end = {0, 0}}, Line{.start = {-9, 1}, .end = {0, 1}});
  passive_.push_back({.text = "M8", .mode = mode_});
  hold(Line{.start = {0, 0}, .end = {4, 0}}, Line{.start = {0, 1}, .end = {4, 1}});
  hold(Line{.start = {4, 0}, .end = {8, 0}}, Line{.start = {4, 1}, .end = {8, 1}});
  walked_.add_whole(0);
  walked_.add({.block = 2, .to = 4, .start = {0, 1}, .end = {8, 1}, .behind_loop = true});
  LoopRelease release(setup_, path_, walked_, obstacles_, diagnostics_);
  release.begin();
  release.release_to(walked_.end(), out_);
  ASSERT_EQ(out_.size(), 3U);
  EXPECT_EQ(out_[1]->role, Role::passive);
  ASSERT_EQ(out_[1]->passive.size(), 1U);
  EXPECT_EQ(out_[1]->passive.front().text, "M8");
  expect_path(*out_[2], {0, 1}, {8, 1});
}

TEST_F(LoopReleaseTest, MoreThanTheShareThatMayBeLeftOutIsRefused) {  // D-39
  hold_narrow_slot();
  walk_past_slot();
  setup_.largest_masked_share = 0.37;  // of 30 mm: 11.1
  EXPECT_TRUE(LoopRelease(setup_, path_, walked_, obstacles_, diagnostics_).check_left_out());
  setup_.largest_masked_share = 0.36;  // 10.8
  EXPECT_FALSE(LoopRelease(setup_, path_, walked_, obstacles_, diagnostics_).check_left_out());
  ASSERT_EQ(diagnostics_.pending().size(), 1U);
  EXPECT_EQ(diagnostics_.pending().front().code, Code::most_left_out);
}

TEST_F(LoopReleaseTest, WholeBlocksLeaveInARow) {
  hold_slot(3);
  walked_.add_whole(0, 7);
  LoopRelease release(setup_, path_, walked_, obstacles_, diagnostics_);
  release.begin();
  EXPECT_EQ(release.next_as_they_came(5).count, 5U);
  release.have_left(5);
  EXPECT_EQ(release.next(), 5U);
  EXPECT_EQ(release.next_as_they_came(5).count, 2U);
  EXPECT_EQ(release.next_part(), nullptr);
}

}  // namespace
}  // namespace trc
