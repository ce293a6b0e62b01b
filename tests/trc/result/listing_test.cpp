#include "core/trc/result/listing.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace trc::testing {
namespace {

std::string listed(const CompensatedBlock& block, int places = 4) {
  const std::array<std::string, 1> axes{"A"};
  std::string line;
  append_listing(line, block, axes, places);
  return line;
}

TEST(Listing, LineWithFeed) {
  EXPECT_EQ(listed({.source = {.number = 40},
                    .origin = Origin::approach,
                    .path = Line{.start = {0, 0}, .end = {30, 30}},
                    .feed = 1000}),
            "40 approach line 0.0000 0.0000 0.0000 -> 30.0000 30.0000 0.0000 F1000");
}

TEST(Listing, RapidHasNoFeedAndNoNumberIsADash) {
  EXPECT_EQ(listed({.rapid = true,
                    .path = Line{.start = {-0.00001, 0}, .end = {1, 0}},
                    .normal = {.from = 5, .to = -5},
                    .feed = 1000}),
            "- uncompensated rapid 0.0000 0.0000 5.0000 -> 1.0000 0.0000 -5.0000");
}

TEST(Listing, ArcHasCentreAndSignedSweepInDegrees) {
  EXPECT_EQ(listed({.source = {.number = 50},
                    .origin = Origin::transition,
                    .path = Arc{.start = {0, 5},
                                .end = {5, 0},
                                .center = {0, 0},
                                .sweep = -std::numbers::pi / 2},
                    .normal = {.from = 2, .to = 2},
                    .feed = 333.3333},
                   1),
            "50 transition arc 0.0 5.0 2.0 -> 5.0 0.0 2.0 center 0.0 0.0 2.0 sweep -90.0 F333.3");
}

TEST(Listing, MachineAxesInOtherPlanes) {
  const Line path{.start = {1, 2}, .end = {3, 4}};
  EXPECT_EQ(listed({.plane = Plane::zx, .path = path, .normal = {.from = 5, .to = 6}}, 0),
            "- uncompensated line 2 5 1 -> 4 6 3");
  EXPECT_EQ(listed({.plane = Plane::yz, .path = path, .normal = {.from = 5, .to = 6}}, 0),
            "- uncompensated line 5 1 2 -> 6 3 4");
}

TEST(Listing, TrackingAxesThatMove) {
  CompensatedBlock block{.path = Line{.start = {0, 0}, .end = {1, 0}}};
  block.tracking = {{.from = 0, .to = 90}, {.from = 1, .to = 2}, {.from = 3, .to = 3}};
  EXPECT_EQ(listed(block, 0), "- uncompensated line 0 0 0 -> 1 0 0 A 0 -> 90 #2 1 -> 2");
}

TEST(Listing, Passthrough) {
  EXPECT_EQ(listed({.source = {.number = 55}, .origin = Origin::passthrough, .text = "M8"}),
            "55 passthrough M8");
  EXPECT_EQ(listed({.origin = Origin::passthrough}), "- passthrough");
}

}  // namespace
}  // namespace trc::testing
