#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/big_contours.h"
#include "tests/support/buffer_judge.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"
#include "tests/support/slow_shapes.h"
#include "tests/support/small_contours.h"

// Loop removal on simple closed contours of many blocks against the buffer of GEOS,
// which knows polygons only: both have to give the same boundary.

namespace trc::support {
namespace {

// The contour, begun within a block where the tool has room, if there is one.
std::optional<std::vector<Segment>> begun_legally(const std::vector<Segment>& contour,
                                                  const TrcMode& mode) {
  const double shift = mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
  for (std::size_t first = 0; first < contour.size(); ++first) {
    const Vector ahead = point_at(contour[first], 0.51) - point_at(contour[first], 0.49);
    const Point tool =
        point_at(contour[first], 0.5) + shift * Vector(-ahead.y(), ahead.x()).normalized();
    const bool room = std::all_of(contour.begin(), contour.end(), [&](const Segment& block) {
      return slow_distance(tool, block) >= mode.tool_radius * (1 - 1e-9);
    });
    if (room) return begun_within(contour, first);
  }
  return std::nullopt;
}

TrcMode removing_loops(Side side, double radius) {
  TrcMode mode;
  mode.side = side;
  mode.tool_radius = radius;
  mode.selection = mode.deselection = Selection::direct;
  mode.transition = Transition::circular;
  mode.masking = Masking::on;
  mode.options.remove_masked_blocks = true;
  return mode;
}

// With leads to where it begins.
Contour led_to(const std::vector<Segment>& closed) {
  const Point first = point_at(closed.front(), 0);
  return {.approach = {.start = first + Vector(1000, 300), .end = first},
          .blocks = closed,
          .retract = {.start = first, .end = first + Vector(1000, -300)}};
}

class Buffer : public ::testing::TestWithParam<std::tuple<BigShape, Side>> {};

TEST_P(Buffer, HasTheSameBoundary) {
  const auto [shape, side] = GetParam();
  Geos geos;
  std::size_t compared = 0;
  for (const std::size_t blocks : {std::size_t{400}, std::size_t{2000}})
    for (const double radius : {0.4, 0.6, 1.0, 3.0, 5.0, 50.0}) {
      SCOPED_TRACE(std::to_string(blocks) + " blocks, R " + std::to_string(radius));
      const TrcMode mode = removing_loops(side, radius);
      const auto whole = big_contour(shape, blocks);
      const auto begun = begun_legally(whole, mode);
      if (!begun) continue;

      const Outcome outcome = compensate(led_to(*begun), mode, {.batch = 0});
      ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
      const auto difference =
          difference_of(geos, points_along(whole, 1e-4 * radius), outcome, mode);
      ASSERT_TRUE(difference.has_value());
      // The chords of GEOS are off by 0.0003 R; what it leaves out of its raw curve to
      // have it simpler comes on top.
      const double error = 1e-3 * radius;
      EXPECT_LE(difference->farthest, error);
      EXPECT_LE(difference->area, error * difference->length);
      ++compared;
    }
  EXPECT_GE(compared, 4U);
}

std::vector<Segment> between_leads(const Outcome& outcome) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks, 1e-9))
    if (block.origin != Origin::approach && block.origin != Origin::retract)
      path.push_back(block.path);
  return path;
}

// The centre path of a tool, with loops removed, as a program in wear mode (D-43): a larger tool
// leaves the part that GEOS makes with its whole radius.
TEST_P(Buffer, HasTheSameBoundaryInWearMode) {
  const auto [shape, side] = GetParam();
  Geos geos;
  std::size_t compared = 0;
  for (const double radius : {0.4, 0.6, 1.0, 3.0, 5.0})
    for (const double wear : {0.02, 0.3}) {
      SCOPED_TRACE("R " + std::to_string(radius) + ", wear " + std::to_string(wear));
      const TrcMode whole_tool = removing_loops(side, radius + wear);
      const auto part = big_contour(shape, 400);
      const auto begun = begun_legally(part, whole_tool);
      if (!begun) continue;
      const Outcome nominal =
          compensate(led_to(*begun), removing_loops(side, radius), {.batch = 0});
      ASSERT_FALSE(nominal.stopped) << message_of(*nominal.error());
      const std::vector<Segment> centre = between_leads(nominal);
      TrcMode mode = removing_loops(side, wear);
      mode.nominal_radius = radius;
      const Outcome outcome = compensate(led_to(centre), mode, {.batch = 0});
      ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
      const auto difference =
          difference_of(geos, points_along(part, 1e-4 * radius), outcome, whole_tool);
      ASSERT_TRUE(difference.has_value());
      // The nominal path is as far off as that of the whole tool, on top of the chords.
      const double error = 1.5e-3 * (radius + wear);
      EXPECT_LE(difference->farthest, error);
      EXPECT_LE(difference->area, error * difference->length);
      ++compared;
    }
  EXPECT_GE(compared, 1U);
}

// A smaller tool (D-43) goes nearer to the part, turns about inside corners of the centre path, and
// is nowhere nearer than it may: GEOS makes the centre path wider by the wear, towards the part.
TEST_P(Buffer, HasTheSameBoundaryWithAWornTool) {
  const auto [shape, side] = GetParam();
  Geos geos;
  std::size_t compared = 0;
  for (const double radius : {0.4, 0.6, 1.0, 3.0, 5.0})
    for (const double worn : {0.02, 0.3}) {
      SCOPED_TRACE("R " + std::to_string(radius) + ", worn by " + std::to_string(worn));
      const TrcMode nominal_tool = removing_loops(side, radius);
      const auto part = big_contour(shape, 400);
      const auto begun = begun_legally(part, nominal_tool);
      if (!begun) continue;
      const Outcome nominal = compensate(led_to(*begun), nominal_tool, {.batch = 0});
      ASSERT_FALSE(nominal.stopped) << message_of(*nominal.error());
      const std::vector<Segment> centre = between_leads(nominal);
      TrcMode mode = removing_loops(side, -worn);
      mode.nominal_radius = radius;
      const Outcome outcome = compensate(led_to(centre), mode, {.batch = 0});
      ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
      const double error = 1.5e-3 * radius;
      const auto difference = difference_of(geos, points_along(centre, 1e-4 * worn), outcome,
                                            removing_loops(other(side), worn));
      ASSERT_TRUE(difference.has_value());
      EXPECT_LE(difference->farthest, error);
      EXPECT_LE(difference->area, error * difference->length);
      const auto walls = geos.line(points_along(part, 1e-4 * radius));
      const auto near_walls = geos.prepared(walls);
      for (const Point& point : points_along(between_leads(outcome), 1e-4 * radius))
        EXPECT_GE(geos.distance(near_walls, point), radius - worn - error);
      ++compared;
    }
  EXPECT_GE(compared, 2U);
}

// Closed contours of a few lines and arcs, on either side, where they are simple.
TEST(BufferOfAFewBlocks, HasTheSameBoundary) {
  Geos geos;
  std::size_t compared = 0;
  std::size_t different = 0;
  for (std::uint64_t seed = 80'000'000; seed < 80'001'000; ++seed) {
    Random random(seed);
    const SmallContour made = small_contour(random, Hardship::rounds);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + text_of(made.mode));
    const double radius = made.mode.tool_radius;
    const auto outline = points_along(made.contour.blocks, 1e-4 * radius);
    if (!geos.is_simple(geos.polygon(outline))) continue;
    const Outcome outcome = compensate(made.contour, made.mode);
    if (outcome.stopped) continue;
    const auto difference = difference_of(geos, outline, outcome, made.mode);
    ++compared;
    // A neck as narrow as the tool, to what the chords are off, may be open here and closed there.
    if (!difference || difference->farthest > 1e-3 * radius ||
        difference->area > 1e-3 * radius * difference->length)
      ++different;
  }
  EXPECT_GT(compared, 300U);
  EXPECT_LE(200 * different, compared);
  std::cout << compared << " compared, " << different << " different\n";
}

// Begun where they are too near by less than the tolerance.
TEST(BufferOfAFewBlocks, IsNotOneLoopFromSeamToSeam) {
  Geos geos;
  for (const std::uint64_t seed : {80'021'016U, 80'027'087U}) {
    Random random(seed);
    const SmallContour made = small_contour(random, Hardship::rounds);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double radius = made.mode.tool_radius;
    const Outcome outcome = compensate(made.contour, made.mode);
    ASSERT_FALSE(outcome.stopped);
    const auto outline = points_along(made.contour.blocks, 1e-4 * radius);
    const auto difference = difference_of(geos, outline, outcome, made.mode);
    ASSERT_TRUE(difference.has_value());
    EXPECT_LE(difference->farthest, 1e-3 * radius);
  }
}

INSTANTIATE_TEST_SUITE_P(LoopRemoval, Buffer,
                         ::testing::Combine(::testing::ValuesIn(all_big_shapes),
                                            ::testing::Values(Side::left, Side::right)),
                         [](const auto& param) {
                           return name_of(std::get<0>(param.param)) +
                                  (std::get<1>(param.param) == Side::left ? "Inside" : "Outside");
                         });

}  // namespace
}  // namespace trc::support
