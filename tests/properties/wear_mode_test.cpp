#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "core/verify/clearance.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// D-43: a contour with R0 + delta, and its centre path for R0 with the wear delta, give the same
// path. TRC_TEST_LONG=1 takes 50 times as many contours.

namespace trc::support {
namespace {

std::size_t scaled(std::size_t count) {
  const char* value = std::getenv("TRC_TEST_LONG");
  return value != nullptr && std::string(value) == "1" ? 50 * count : count;
}

std::vector<Segment> between_leads(const Outcome& outcome) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks, 1e-9))
    if (block.origin != Origin::approach && block.origin != Origin::retract)
      path.push_back(block.path);
  return path;
}

double distance_to(const std::vector<Segment>& path, const Point& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& segment : path) least = std::min(least, slow_distance(point, segment));
  return least;
}

double farthest_off(const std::vector<Segment>& path, const std::vector<Segment>& other) {
  double farthest = 0;
  for (const Segment& segment : path)
    for (const double share : {0.0, 0.3, 0.5, 1.0})
      farthest = std::max(farthest, distance_to(other, point_at(segment, share)));
  return farthest;
}

// The path of a nominal tool as a program of its own.
Contour centre_program(const Contour& contour, const std::vector<Segment>& path) {
  return {.approach = Line{contour.approach.start, start_of(path.front())},
          .blocks = path,
          .retract = Line{end_of(path.back()), contour.retract.end}};
}

struct Tried {
  Contour contour{};
  TrcMode mode{};  // of the nominal tool
  double delta = 0;
};

Tried tried(std::uint64_t seed) {
  Random random(seed);
  Tried made{.delta = random.between(-0.4, 0.4)};
  made.mode.side = random.chance(0.5) ? Side::left : Side::right;
  made.mode.tool_radius = random.between(1, 10);
  made.mode.selection = Selection::direct;
  made.mode.transition = Transition::circular;
  // A smaller tool reaches deeper into a sharp inside corner than wear mode can know of.
  const Flavor flavor = made.delta < 0 || random.chance(0.3) ? Flavor::convex : Flavor::mixed;
  TrcMode larger = made.mode;
  larger.tool_radius += std::max(0.0, made.delta);
  made.contour = random_clean_contour(random, flavor, larger, 8);
  return made;
}

TEST(WearMode, GivesThePathOfTheContourWithTheWholeRadius) {
  const std::size_t count = scaled(2000);
  std::size_t compared = 0;
  for (std::uint64_t seed = 91'000'000; seed < 91'000'000 + count && !HasFailure(); ++seed) {
    const Tried made = tried(seed);
    TrcMode whole = made.mode;
    whole.tool_radius += made.delta;
    const Outcome nominal = compensate(made.contour, made.mode);
    const Outcome expected = compensate(made.contour, whole);
    const std::vector<Segment> centre = between_leads(nominal);
    if (nominal.stopped || expected.stopped || centre.empty()) continue;
    TrcMode wear = made.mode;
    wear.nominal_radius = made.mode.tool_radius;
    wear.tool_radius = made.delta;
    const Outcome actual = compensate(centre_program(made.contour, centre), wear);
    if (actual.stopped) continue;
    std::ostringstream story;
    story << "seed " << seed << ", delta " << made.delta << ", " << text_of(made.mode) << '\n'
          << made.contour;
    SCOPED_TRACE(story.str());
    const auto wanted = between_leads(expected);
    const auto given = between_leads(actual);
    ASSERT_FALSE(wanted.empty());
    ASSERT_FALSE(given.empty());
    EXPECT_LT(farthest_off(given, wanted), 1e-6);
    EXPECT_LT(farthest_off(wanted, given), 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, count / 2);
}

// What is measured in wear mode is the distance to the part, and a path that is too deep is found.
TEST(WearMode, IsMeasuredAgainstThePart) {
  std::size_t measured = 0;
  for (std::uint64_t seed = 92'000'000; seed < 92'000'300 && !HasFailure(); ++seed) {
    const Tried made = tried(seed);
    const Outcome nominal = compensate(made.contour, made.mode);
    const std::vector<Segment> centre = between_leads(nominal);
    if (nominal.stopped || centre.empty()) continue;
    const Contour program = centre_program(made.contour, centre);
    for (const double deeper : {0.0, 0.01}) {
      TrcMode mode = made.mode;
      mode.nominal_radius = made.mode.tool_radius;
      mode.tool_radius = made.delta - deeper;
      const Outcome outcome = compensate(program, mode);
      if (outcome.stopped) continue;
      mode.selection_number = 1;
      mode.below_nominal = made.delta < 0;
      mode.tool_radius = std::abs(made.delta);
      if (mode.below_nominal) mode.side = other(mode.side);
      const auto shared = std::make_shared<const TrcMode>(mode);
      std::vector<Block> programmed;
      const auto add = [&](const Segment& path) {
        programmed.emplace_back(
            MotionBlock{.source = {.index = programmed.size()}, .path = path, .mode = shared});
      };
      add(program.approach);
      for (const Segment& block : program.blocks) add(block);
      const auto report = verify::measure_clearance(programmed, outcome.blocks, 1e-4);
      if (!report.worst) continue;
      SCOPED_TRACE(seed);
      const double tool = made.mode.tool_radius + made.delta;
      EXPECT_NEAR(report.worst->required, tool, 1e-9);
      if (deeper > 0)
        EXPECT_LE(report.worst->distance, tool - deeper + 1e-6);
      else
        EXPECT_GE(report.worst->distance, tool - 1e-4);
      ++measured;
    }
  }
  EXPECT_GT(measured, 200U);
}

}  // namespace
}  // namespace trc::support
