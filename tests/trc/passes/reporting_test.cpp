#include "core/trc/passes/reporting.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "tests/trc/passes/given_blocks.h"

// What becomes of a path block when it comes out. The tool has the radius 2 and is left of the
// contour; its feed is 100.

namespace trc {
namespace {

using support::contour_block;
using support::left_of_contour;

class ReportingPass : public ::testing::Test {
 protected:
  CompensatorSetup setup_from(double x, double y) { return {.start = {x, y, 0}}; }
  // A quarter of a circle about the zero point from (radius, 0), and its path.
  PathBlockPtr quarter(double radius, FeedAdaptation adaptation) {
    TrcMode mode = left_of_contour(2);
    mode.feed_adaptation = adaptation;
    const double sweep = std::numbers::pi / 2;
    const auto about_zero = [&](double r) {
      return Arc{.start = {r, 0}, .end = {0, r}, .center = Point::Zero(), .sweep = sweep};
    };
    PathBlockPtr block = contour_block(about_zero(radius), mode);
    block->tool_path = about_zero(radius - 2);
    return block;
  }
  PathBlockPtr line(const Point& start, const Point& end) {
    PathBlockPtr block = contour_block(Line{.start = start, .end = end}, left_of_contour(2));
    block->tool_path = Line{.start = start, .end = end};
    return block;
  }
  double feed_of(PathBlockPtr block) {
    const Point& start = start_of(block->tool_path);
    Reporting pass(setup_from(start.x(), start.y()), diagnostics_);
    std::vector<CompensatedBlock> out;
    EXPECT_TRUE(pass.feed(std::move(block), out));
    return out.empty() ? 0 : out.front().feed;
  }

  Diagnostics diagnostics_;
};

TEST_F(ReportingPass, KeepsTheFeedOfTheTool) {  // G10
  EXPECT_EQ(feed_of(quarter(10, FeedAdaptation::off)), 100);
}

TEST_F(ReportingPass, AdaptsTheFeedSoThatItHoldsAtTheContour) {  // G11
  EXPECT_NEAR(feed_of(quarter(10, FeedAdaptation::on)), 80, 1e-12) << "8 / 10 of it inside";
  PathBlockPtr outside = quarter(10, FeedAdaptation::on);
  TrcMode mode = outside->mode();
  mode.side = Side::right;
  outside->programmed.mode = std::make_shared<const TrcMode>(mode);
  outside->at_start.shift = outside->at_end.shift = -2;
  outside->tool_path =
      Arc{.start = {12, 0}, .end = {0, 12}, .center = Point::Zero(), .sweep = std::numbers::pi / 2};
  mode.feed_adaptation = FeedAdaptation::inside;
  PathBlockPtr limited = std::make_unique<PathBlock>(*outside);
  limited->programmed.mode = std::make_shared<const TrcMode>(mode);
  EXPECT_NEAR(feed_of(std::move(outside)), 120, 1e-12) << "12 / 10 of it outside";
  EXPECT_EQ(feed_of(std::move(limited)), 100) << "only inside";
}

TEST_F(ReportingPass, LeavesSomethingOfTheFeed) {  // D-31
  EXPECT_NEAR(feed_of(quarter(2.001, FeedAdaptation::on)), 1, 1e-12) << "0.01, not 0.0005";
}

TEST_F(ReportingPass, PutsPassiveBlocksBehindTheirBlock) {  // D-25
  Reporting pass(setup_from(0, 0), diagnostics_);
  PathBlockPtr first = line({0, 0}, {5, 0});
  first->passive.push_back({.text = "M8", .mode = first->programmed.mode});
  std::vector<CompensatedBlock> out;
  ASSERT_TRUE(pass.feed(std::move(first), out));
  ASSERT_TRUE(pass.feed(line({5, 0}, {5, 3}), out));
  ASSERT_EQ(out.size(), 3U);
  EXPECT_EQ(out[1].origin, Origin::passthrough);
  EXPECT_EQ(out[1].text, "M8");
  EXPECT_EQ(start_of(out[1].path), Point(5, 0));
  EXPECT_EQ(end_of(out[1].path), Point(5, 0));
  EXPECT_EQ(pass.summary().blocks_out, 3U);
  EXPECT_NEAR(pass.summary().compensated_length, 8, 1e-12);
}

TEST_F(ReportingPass, TellsWhereThePathGoesOnSmoothly) {  // rule 4.5
  TrcMode mode = left_of_contour(2);
  mode.options.tangential_limit = 1;  // degree
  const auto turned = [&](double degrees) {
    Reporting pass(setup_from(0, 0), diagnostics_);
    const double angle = degrees * std::numbers::pi / 180;
    PathBlockPtr next = line({5, 0}, Point(5, 0) + Point(std::cos(angle), std::sin(angle)));
    next->programmed.mode = std::make_shared<const TrcMode>(mode);
    std::vector<CompensatedBlock> out;
    EXPECT_TRUE(pass.feed(line({0, 0}, {5, 0}), out) && pass.feed(std::move(next), out));
    EXPECT_FALSE(out.front().tangential);
    return out.back().tangential;
  };
  EXPECT_TRUE(turned(0));
  EXPECT_TRUE(turned(0.9));
  EXPECT_TRUE(turned(-0.9));
  EXPECT_FALSE(turned(1.1));
  EXPECT_FALSE(turned(180));
}

TEST_F(ReportingPass, TakesAGapForABrokenPromise) {
  Reporting pass(setup_from(0, 0), diagnostics_);
  std::vector<CompensatedBlock> out;
  ASSERT_TRUE(pass.feed(line({0, 0}, {5, 0}), out));
  EXPECT_THROW(pass.feed(line({5, 1e-9}, {9, 0}), out), BrokenInvariant);
}

}  // namespace
}  // namespace trc
