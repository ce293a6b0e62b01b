#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/trc/loops/seam.h"
#include "tests/trc/loops/loop_room.h"

// What the walk of loop removal asks: what is in the way, what has been walked, where a closed
// contour begins and ends.

namespace trc {
namespace {

class LoopRooms : public LoopRoom {
 protected:
  Seam seam_{path_, tolerances_};
};

TEST_F(LoopRooms, ThePathComesTooNearWhereAWallIsOneRadiusAway) {
  hold_hook();
  const auto onset = obstacles_.onset(0, 0, 10, Nearness::exact);
  ASSERT_TRUE(onset);
  EXPECT_EQ(onset->obstacle, 3U);
  EXPECT_NEAR(onset->along, 5, 1e-4);
  EXPECT_FALSE(obstacles_.onset(0, 0, 4.99, Nearness::exact));
  EXPECT_FALSE(obstacles_.comes_nearer(0, 0, 4.99, Nearness::passable));
  EXPECT_TRUE(obstacles_.comes_nearer(0, 0, 5.01, Nearness::passable));
}

TEST_F(LoopRooms, ALeadIsInNobodysWay) {  // D-137
  hold_hook();
  obstacles_.set_walls({.leads = {{.first = 3, .end = 4}}});
  EXPECT_TRUE(obstacles_.is_lead(3));
  EXPECT_FALSE(obstacles_.onset(0, 0, 10, Nearness::exact));
}

TEST_F(LoopRooms, WhatTurnsByLessThanHalfATurnIsNotAskedAbout) {
  hold_hook();
  EXPECT_TRUE(obstacles_.certifies(0, 1));
  EXPECT_FALSE(obstacles_.certifies(0, 3));
  EXPECT_EQ(obstacles_.chain_before(3), 2U);
}

TEST_F(LoopRooms, BlocksThatMeetInOnePlaceAreFoundTogether) {
  hold({{0, 0}, {10, 0}, {10, 5}, {6, 5}, {6, 1.5}, {5, 5}});
  const auto onset = obstacles_.onset(0, 0, 10, Nearness::exact);
  ASSERT_TRUE(onset);
  const Point place(onset->along, 1);
  const std::vector<std::size_t> near = obstacles_.at(0, place, onset->obstacle, Nearness::exact);
  EXPECT_EQ(near.size(), 2U) << "both blocks of the tip in (6,1.5)";
}

TEST_F(LoopRooms, APieceIsAWholeBlockUnlessItIsCut) {
  hold({{0, 0}, {10, 0}, {20, 0}, {30, 0}});
  walked_.add_whole(0);
  walked_.add({.block = 1, .from = 2, .to = 7, .start = {12, 1}, .end = {17, 1}});
  walked_.add_whole(2);
  EXPECT_EQ(walked_.whole_in_a_row(0, 3), 1U);
  EXPECT_EQ(walked_[0].to, 10);
  EXPECT_EQ(walked_[0].end, Point(10, 1));
  EXPECT_EQ(walked_[1].from, 2);
  EXPECT_EQ(walked_[1].end, Point(17, 1));
  walked_.truncate(1);
  EXPECT_EQ(walked_.end(), 1U);
  walked_.add({.block = 1, .to = 3, .start = {10, 1}, .end = {13, 1}});
  EXPECT_EQ(walked_[1].to, 3) << "what was cut before is forgotten";
}

TEST_F(LoopRooms, PiecesAreFoundByWhereTheirBlocksLie) {
  hold({{0, 0}, {10, 0}, {20, 0}, {30, 0}});
  walked_.add_whole(0, 3);
  const auto found_near = [&](const Point& place, const BoxTree::Range& skipped) {
    std::vector<std::size_t> found;
    walked_.for_each_near(bounding_box(place, place), 1, skipped,
                          [&](std::size_t number) { found.push_back(number); });
    return found;
  };
  EXPECT_EQ(found_near({25, 1}, {}), std::vector<std::size_t>{2});
  EXPECT_EQ(found_near({10, 1.5}, {}), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(found_near({10, 1.5}, {.first = 0, .last = 0}), std::vector<std::size_t>{1});
  EXPECT_TRUE(found_near({15, 3}, {}).empty());
}

TEST_F(LoopRooms, TheSeamIsWhereAClosedContourBeginsAndEnds) {
  hold({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, 1);
  EXPECT_TRUE(seam_.is_near({0, 0.009}));
  EXPECT_FALSE(seam_.is_near({0, 0.02}));
  EXPECT_TRUE(seam_.is_near({3, 8}));
  EXPECT_FALSE(seam_.is_near({2, 4}));
}

TEST_F(LoopRooms, WhatLeadsOverTheSeamIsNoLoopUnlessItHasRoomForTheTool) {
  hold({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, 1);
  EXPECT_TRUE(seam_.is_between({0, 0}, {3, 8}, {1, 1}));
  EXPECT_TRUE(seam_.is_between({0, 0.9}, {3, 8}, {1, 1}));
  EXPECT_FALSE(seam_.is_between({0, 1.1}, {3, 8}, {1, 1})) << "a room in front of it";
  EXPECT_FALSE(seam_.is_between({0, 0}, {3, 6.9}, {1, 1})) << "a room behind it";
  EXPECT_FALSE(seam_.is_between({0, 0}, {3, 8}, {1, 1.02})) << "not at the seam";
  EXPECT_FALSE(seam_.is_between({0, 0}, {1, 8}, {1, 1})) << "not all of the contour";
}

TEST_F(LoopRooms, AnOpenContourHasNoSeam) {
  hold({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0.1}});
  EXPECT_FALSE(seam_.is_near({0, 0}));
  EXPECT_FALSE(seam_.is_between({0, 0}, {3, 10}, {0, 1}));
}

}  // namespace
}  // namespace trc
