#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/verify/clearance.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// D-43: a contour with R0 + delta, and its centre path for R0 with the wear delta, give the same
// path. TRC_TEST_LONG=1 takes 50 times as many contours.

namespace trc::support {
namespace {

std::size_t scaled(std::size_t count) { return is_long_run() ? 50 * count : count; }

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

Tried tried(std::uint64_t seed, bool of_lines = false) {
  Random random(seed);
  Tried made{.delta = random.between(-0.4, 0.4)};
  made.mode.side = random.chance(0.5) ? Side::left : Side::right;
  made.mode.tool_radius = random.between(1, 10);
  made.mode.selection = Selection::direct;
  made.mode.transition = Transition::circular;
  // A smaller tool reaches deeper into a sharp inside corner than wear mode can know of.
  const Flavor any = of_lines ? Flavor::lines : Flavor::mixed;
  const Flavor flavor = made.delta < 0 || random.chance(0.3) ? Flavor::convex : any;
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

// Of the path of a program under the rules of `mode`, with the radius the tool has in truth.
std::optional<verify::Clearance> measured(const Contour& program, TrcMode mode,
                                          const Outcome& outcome) {
  mode.selection_number = 1;
  mode.below_nominal = mode.tool_radius < 0;
  mode.tool_radius = std::abs(mode.tool_radius);
  if (mode.below_nominal) mode.side = other(mode.side);
  const auto shared = std::make_shared<const TrcMode>(mode);
  std::vector<Block> programmed;
  const auto add = [&](const Segment& path) {
    programmed.emplace_back(
        MotionBlock{.source = {.index = programmed.size()}, .path = path, .mode = shared});
  };
  add(program.approach);
  for (const Segment& block : program.blocks) add(block);
  return verify::measure_clearance(programmed, outcome.blocks, 1e-4, all_walls().leads).worst;
}

// What is measured in wear mode is the distance to the part, and a path that is too deep is found.
// Random contours run into themselves: those the whole radius keeps clear of are asked.
TEST(WearMode, IsMeasuredAgainstThePart) {
  std::size_t asked = 0;
  std::size_t with_mitres = 0;
  for (std::uint64_t seed = 92'000'000; seed < 92'002'000 && !HasFailure(); ++seed) {
    Tried made = tried(seed, seed % 2 == 0);
    const bool of_lines =
        std::none_of(made.contour.blocks.begin(), made.contour.blocks.end(), is_arc);
    // Mitres and chamfers about corners of lines: there is no arc of the centre path then.
    if (of_lines) made.mode.transition = Transition::linear;
    TrcMode whole = made.mode;
    whole.tool_radius += made.delta;
    const Outcome expected = compensate(made.contour, whole);
    const Outcome nominal = compensate(made.contour, made.mode);
    const std::vector<Segment> centre = between_leads(nominal);
    if (nominal.stopped || expected.stopped || centre.empty()) continue;
    const auto clear = measured(made.contour, whole, expected);
    if (!clear || clear->margin() < -1e-5) continue;
    const Contour program = centre_program(made.contour, centre);
    std::ostringstream story;
    story << "seed " << seed << ", delta " << made.delta << ", " << text_of(made.mode) << '\n'
          << made.contour;
    SCOPED_TRACE(story.str());
    for (const double deeper : {0.0, 0.01}) {
      TrcMode mode = made.mode;
      mode.nominal_radius = made.mode.tool_radius;
      mode.tool_radius = made.delta - deeper;
      const Outcome outcome = compensate(program, mode);
      if (outcome.stopped) continue;
      mode.tool_radius = made.delta;
      const auto found = measured(program, mode, outcome);
      if (!found) continue;
      EXPECT_NEAR(found->required, made.mode.tool_radius + made.delta, 1e-9);
      if (deeper > 0)
        EXPECT_LE(found->margin(), 1e-4 - deeper);
      else
        EXPECT_GE(found->margin(), -1e-4);
      ++asked;
      with_mitres += of_lines ? 1 : 0;
    }
  }
  EXPECT_GT(asked, 500U);
  EXPECT_GT(with_mitres, 100U);
}

double value_of(const Diagnostic& told, std::string_view name) {
  for (const DiagnosticValue& value : told.values)
    if (value.name == name) return value.value;
  return std::numeric_limits<double>::quiet_NaN();
}

const Diagnostic* found(const Outcome& outcome, Code code) {
  for (const Diagnostic& told : outcome.diagnostics)
    if (told.code == code) return &told;
  return nullptr;
}

TrcMode wear_mode(double delta) {
  TrcMode mode;
  mode.side = Side::left;
  mode.nominal_radius = 5;
  mode.tool_radius = delta;
  mode.selection = Selection::direct;
  mode.transition = Transition::circular;
  return mode;
}

// Along X and up, with a fillet of the centre path between; 0: none.
Contour inside_corner(double fillet) {
  Contour contour;
  contour.approach = Line{{-10, 0}, {0, 0}};
  contour.blocks.emplace_back(Line{{0, 0}, {50 - fillet, 0}});
  if (fillet > 0)
    contour.blocks.emplace_back(Arc{.start = {50 - fillet, 0},
                                    .end = {50, fillet},
                                    .center = {50 - fillet, fillet},
                                    .sweep = std::numbers::pi / 2});
  contour.blocks.emplace_back(Line{{50, fillet}, {50, 50}});
  contour.retract = Line{{50, 50}, {30, 60}};
  return contour;
}

TEST(WearMode, NamesTheFilletOfThePartAndTheWholeTool) {
  const Outcome outcome = compensate(inside_corner(0.1), wear_mode(0.25));
  const Diagnostic* refused = found(outcome, Code::tool_not_smaller_than_arc);
  ASSERT_NE(refused, nullptr);
  EXPECT_NEAR(value_of(*refused, "contour_radius"), 5.1, 1e-9);
  EXPECT_NEAR(value_of(*refused, "tool_radius"), 5.25, 1e-9);
}

TEST(WearMode, TellsHowMuchDeeperASmallerToolCouldGo) {
  const Outcome outcome = compensate(inside_corner(0), wear_mode(-0.1));
  const Diagnostic* told = found(outcome, Code::wear_not_deeper);
  ASSERT_NE(told, nullptr);
  EXPECT_FALSE(outcome.stopped);
  EXPECT_NEAR(value_of(*told, "deeper"), 0.1 * (std::numbers::sqrt2 - 1), 1e-9);
  EXPECT_NEAR(value_of(*told, "tool_radius"), 4.9, 1e-9);
  EXPECT_EQ(found(compensate(inside_corner(0), wear_mode(0.1)), Code::wear_not_deeper), nullptr);
  EXPECT_EQ(found(compensate(inside_corner(2), wear_mode(-0.1)), Code::wear_not_deeper), nullptr);
}

// G11: the feed is the one at the part, whose fillet is larger by the nominal radius.
TEST(WearMode, KeepsTheFeedAtThePart) {
  for (const double delta : {0.2, -0.2}) {
    TrcMode mode = wear_mode(delta);
    mode.feed_adaptation = FeedAdaptation::on;
    const Outcome outcome = compensate(inside_corner(10), mode);
    ASSERT_FALSE(outcome.stopped);
    std::size_t arcs = 0;
    for (const CompensatedBlock& block : moving(outcome.blocks, 1e-9)) {
      if (!is_arc(block.path)) continue;
      EXPECT_NEAR(block.feed, 1000 * (10 - delta) / 15, 1e-6) << delta;
      ++arcs;
    }
    EXPECT_EQ(arcs, 1U) << delta;
  }
}

}  // namespace
}  // namespace trc::support
