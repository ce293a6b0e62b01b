#include "core/trc/passes/split.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/trc/passes/given_blocks.h"

// Feeds of their own next to the contour.

namespace trc {
namespace {

using support::all_from;
using support::approach_block;
using support::expect_point;
using support::in_a_row;
using support::left_of_contour;

TEST(SplitPass, GivesThePartNextToTheContourAFeedOfItsOwn) {  // rule 7.2
  TrcMode mode = left_of_contour(2);
  mode.options.split = {
      .where = SplitOption::Where::pre, .along_path = true, .distance_1 = 10, .feed_1 = 50};
  PathBlockPtr approach = approach_block({.start = {0, 0}, .end = {100, 0}}, mode);
  approach->tool_path = Line{.start = {0, 0}, .end = {100, 0}};
  approach->splittable = true;
  Split pass(Tolerances{});
  const PathBlocks out = all_from(pass, in_a_row(std::move(approach)));
  ASSERT_EQ(out.size(), 2U);
  expect_point(end_of(out[0]->tool_path), 90, 0);
  EXPECT_EQ(out[0]->programmed.feed, 100);
  expect_point(end_of(out[1]->tool_path), 100, 0);
  EXPECT_EQ(out[1]->programmed.feed, 50);
}

// The rounding of a difference decides nothing.
TEST(SplitPass, GivesALineAsLongAsThePartItsFeed) {  // D-14
  TrcMode mode = left_of_contour(2);
  mode.options.split = {
      .where = SplitOption::Where::pre, .along_path = true, .distance_1 = 10, .feed_1 = 50};
  const auto split = [&](double length, double second) {
    mode.options.split.distance_2 = second;
    mode.options.split.feed_2 = second > 0 ? 20 : 0;
    PathBlockPtr approach = approach_block({.start = {0, 0}, .end = {length, 0}}, mode);
    approach->tool_path = Line{.start = {0, 0}, .end = {length, 0}};
    approach->splittable = true;
    Split pass(Tolerances{});
    std::vector<double> feeds;
    for (const PathBlockPtr& part : all_from(pass, in_a_row(std::move(approach))))
      feeds.push_back(part->programmed.feed);
    return feeds;
  };
  for (const double more : {-9e-5, -1e-12, 0.0, 1e-12, 9e-5}) {
    EXPECT_EQ(split(10 + more, 0), std::vector<double>{50}) << more;
    EXPECT_EQ(split(14 + more, 4), (std::vector<double>{50, 20})) << more;
  }
  EXPECT_EQ(split(9.9998, 0), std::vector<double>{100});
  EXPECT_EQ(split(13.9998, 4), (std::vector<double>{100, 20}));
  EXPECT_EQ(split(10.0002, 0), (std::vector<double>{100, 50}));
}

}  // namespace
}  // namespace trc
