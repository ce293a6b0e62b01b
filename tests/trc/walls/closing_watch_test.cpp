#include "core/trc/walls/closing_watch.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

// When a window knows what is a lead (D-158): a square of 40 by 40 mm, gone round from the middle
// of its first side, with a lead-in of one line. The tool radius is 2 mm.

namespace trc {
namespace {

class Watch : public ::testing::Test {
 protected:
  // Lines on from where the last one has ended. Returns whether the lead-in has become known.
  bool go(const std::vector<Point>& corners) {
    bool found = false;
    for (const Point& corner : corners) {
      const Segment block = Line{.start = at_, .end = corner};
      at_ = corner;
      watch_.note(blocks_.size(), block, 2);
      blocks_.push_back(block);
      boxes_.append(bounding_box(block));
      const ContourView contour{.count = blocks_.size(),
                                .segment = [this](std::size_t number) { return blocks_[number]; },
                                .tool_side = Side::left};
      if (auto walls = watch_.find_lead_in(contour, boxes_)) {
        lead_in_ = walls->leads;
        found = true;
      }
    }
    return found;
  }
  static std::vector<Point> lap() { return {{20, 0}, {20, 40}, {-20, 40}, {-20, 0}, {0, 0}}; }

  ClosingWatch watch_{LeadSettings{}, 8};
  std::vector<Walls::Range> lead_in_{};

 private:
  Point at_{-5, 10};
  std::vector<Segment> blocks_{};
  BoxTree boxes_{};
};

TEST_F(Watch, ABlockNearTheStartMayBeALead) {
  go({{0, 0}, {20, 0}});
  EXPECT_TRUE(watch_.is_undecided(1, 0));
  EXPECT_TRUE(watch_.needs_begin());
  EXPECT_FALSE(watch_.begin_of_last_lap());
}

TEST_F(Watch, ASecondLapMakesTheLeadInKnown) {
  go({{0, 0}});
  EXPECT_FALSE(go(lap()));
  EXPECT_TRUE(go(lap()));
  EXPECT_EQ(lead_in_, (std::vector<Walls::Range>{{.first = 0, .end = 1}}));
  EXPECT_FALSE(watch_.needs_begin());
  EXPECT_FALSE(watch_.is_undecided(5, 0));
}

TEST_F(Watch, WhatFollowsALapMayBeALeadOut) {
  go({{0, 0}});
  go(lap());
  go(lap());
  go(lap());
  go({{5, 10}});
  EXPECT_TRUE(watch_.is_undecided(11, 16));
  EXPECT_FALSE(watch_.is_undecided(11, 15));
  EXPECT_EQ(watch_.begin_of_last_lap(), 11U);
}

TEST_F(Watch, AContourThatTouchesItsStartAndGoesOnElsewhereHasNoLeadIn) {
  go({{0, 0}});
  go(lap());
  EXPECT_FALSE(go({{10, -30}, {20, -30}, {30, -30}, {40, -30}, {50, -30}, {60, -30}, {70, -30}}));
  EXPECT_TRUE(watch_.needs_begin());
}

TEST_F(Watch, BlocksThatNoWindowShowsBesideTheStartAreDecided) {
  go({{0, 0}});
  for (int step = 1; step <= 40; ++step) go({{10.0 * step, 0}});
  EXPECT_FALSE(watch_.needs_begin());
  EXPECT_FALSE(watch_.is_undecided(0, 8));
}

TEST(ClosingWatch, IsOverWithoutAWindowAndWhereNoLeadsAreLookedFor) {
  EXPECT_FALSE(ClosingWatch(LeadSettings{}, 0).needs_begin());
  EXPECT_FALSE(ClosingWatch({.find = LeadSettings::Find::none}, 8).needs_begin());
}

}  // namespace
}  // namespace trc
