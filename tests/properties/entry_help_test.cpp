#include "core/base/entry_help.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// What a refused approach or retract proposes, put in: it is accepted and keeps clear. Each entry
// has a seed of its own, which a failure prints; TRC_TEST_LONG=1 takes 100,000 of each kind.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

std::uint64_t samples() { return is_long_run() ? 100'000 : 3'000; }

// A selection with what leads to its contour and off it.
struct Program {
  TrcMode mode{};
  Selection deselection = Selection::direct;
  Point start = Point::Zero();
  std::vector<Segment> way_in{};
  std::vector<Segment> contour{};
  std::vector<Segment> way_out{};
  CompensatorSetup compensator = all_walls();
  std::size_t leads_out = 0;   // at the end of the contour
  bool tangential_in = false;  // G05
  bool tangential_out = false;
};

constexpr std::size_t first_of_way_out = 1000;

double height_at(std::size_t ordinal) { return 0.25 * static_cast<double>(ordinal % 7); }

// Of the way in the numbers are 0, 1; of the contour they begin with 100. Each block moves across
// the plane, too.
Outcome compensate(const Program& program) {
  Channel channel(program.mode, program.start, 1, program.compensator);
  std::size_t ordinal = 0;
  if (program.tangential_in) channel.note(channel.program().set_tangential(channel.place(0)));
  channel.note(channel.program().select(program.mode.side, channel.place(0)));
  const auto give = [&](const Segment& block) {
    channel.move(block, ordinal, height_at(ordinal));
    ++ordinal;
  };
  for (const Segment& block : program.way_in) give(block);
  ordinal = 100;
  for (const Segment& block : program.contour) give(block);
  ordinal = first_of_way_out;
  for (std::size_t k = 0; k < program.way_out.size(); ++k, ++ordinal) {
    if (k + 1 == program.way_out.size() && channel.running()) {
      if (program.mode.selection != Selection::inside_corner)
        channel.note(channel.program().set_selection(program.deselection, channel.place(ordinal)));
      if (program.tangential_out)
        channel.note(channel.program().set_tangential(channel.place(ordinal)));
      channel.note(channel.program().deselect(channel.place(ordinal)));
    }
    channel.move(program.way_out[k], ordinal, height_at(ordinal));
  }
  return channel.finish(ordinal);
}

Point in_plane(const DiagnosticPoint& point, Plane plane) {
  return to_plane(plane, {point.x, point.y, point.z});
}

// Of the proposal.
std::vector<Segment> motions_of(const EntryProposal& proposal, Plane plane) {
  std::vector<Segment> motions;
  Point at = in_plane(proposal.start, plane);
  for (const ProposedBlock& block : proposal.blocks) {
    const Point end = in_plane(block.end, plane);
    if (block.center) {
      motions.emplace_back(Arc{
          .start = at, .end = end, .center = in_plane(*block.center, plane), .sweep = block.sweep});
    } else {
      motions.emplace_back(Line{.start = at, .end = end});
    }
    at = end;
  }
  return motions;
}

// The program with the proposal in place of what was refused.
Program with(const Program& program, const EntryHelp& help, const EntryProposal& proposal) {
  Program changed = program;
  const std::vector<Segment> motions = motions_of(proposal, program.mode.plane);
  if (help.leaves) {
    changed.way_out = motions;
  } else {
    changed.start = in_plane(proposal.start, program.mode.plane);
    changed.way_in = motions;
    if (proposal.shape == EntryProposal::Shape::inside_corner)
      changed.mode.selection = Selection::inside_corner;
    std::vector<Segment>& contour = changed.contour;
    contour.erase(contour.begin(), contour.begin() + help.replaced);
    contour.resize(contour.size() - help.left_out);
    changed.leads_out -= help.left_out;
    if (help.left_out > 0)
      changed.way_out = {
          Line{.start = point_at(contour.back(), 1), .end = point_at(program.way_out.back(), 1)}};
  }
  return changed;
}

double nearest(const Segment& path, const Segment& wall) {
  double least = 1e300;
  for (int part = 0; part <= 64; ++part)
    least = std::min(least, slow_distance(point_at(path, part / 64.0), wall));
  return least;
}

void expect_clear(const Program& program, const EntryHelp& help, const Outcome& outcome) {
  const std::size_t known =
      std::min<std::size_t>(help.tried_on, program.contour.size() - program.leads_out);
  const auto walls = help.leaves ? std::span(program.contour).last(known)
                                 : std::span(program.contour).first(known);
  for (const CompensatedBlock& block : moving(outcome.blocks, 1e-6)) {
    const auto number = static_cast<std::size_t>(block.source.number);
    const bool of_way =
        help.leaves ? number >= first_of_way_out || block.origin == Origin::retract : number < 100;
    if (!of_way) continue;
    for (const Segment& wall : walls)
      ASSERT_GE(nearest(block.path, wall), program.mode.tool_radius - 1.5e-4) << text_of(block);
  }
}

// Returns whether there was something to put in.
bool expect_useful(const Program& program, const Diagnostic& error) {
  if (!error.entry_help) return false;
  const EntryHelp& help = *error.entry_help;
  EXPECT_LE(help.proposals.size(), 2U);
  for (const EntryProposal& proposal : help.proposals) {
    EXPECT_LE(proposal.blocks.size(), 2U);
    const Program changed = with(program, help, proposal);
    const Outcome outcome = compensate(changed);
    EXPECT_FALSE(outcome.stopped) << message_of(*outcome.error()) << " with proposal "
                                  << static_cast<int>(proposal.shape);
    if (!outcome.stopped) expect_clear(changed, help, outcome);
  }
  return !help.proposals.empty();
}

std::string story_of(std::uint64_t seed, const Program& program) {
  std::ostringstream story;
  const Segment& out = program.way_out.back();
  Contour contour{.approach = {.start = program.start, .end = point_at(program.way_in.back(), 1)},
                  .blocks = program.contour,
                  .retract = {.start = point_at(out, 0), .end = point_at(out, 1)}};
  story << "seed " << seed << ", " << text_of(program.mode) << '\n' << contour;
  return story.str();
}

constexpr Flavor flavors[] = {Flavor::mixed, Flavor::lines, Flavor::grid, Flavor::convex};

// A block of G236 of up to 1.5 R at the start, or at the end, of a contour that can be machined.
Program on_path(std::uint64_t seed, bool leaves) {
  Random random(seed);
  Program program;
  program.mode = random_mode(random);
  program.mode.options.g236_lin = random.chance(0.3);
  const Contour contour = random_clean_contour(random, flavors[random.below(4)], program.mode,
                                               random.chance(0.7) ? 2 : 6);
  const double radius = program.mode.tool_radius;
  const double length = radius * random.between(0.01, 1.5);
  program.contour = contour.blocks;
  program.mode.selection = leaves ? Selection::direct : Selection::on_path;
  program.deselection = leaves ? Selection::on_path : Selection::direct;
  const double turn = random.between(-pi, pi);
  const Vector along(std::cos(turn), std::sin(turn));
  if (leaves) {
    program.start = contour.approach.start;
    program.way_in = {contour.approach};
    const Point corner = contour.retract.start;
    program.way_out = {Line{.start = corner, .end = corner + length * along}};
  } else {
    const Point corner = contour.approach.end;
    program.start = corner - length * along;
    program.way_in = {Line{.start = program.start, .end = corner}};
    program.way_out = {contour.retract};
  }
  return program;
}

void expect_useful_on_path(bool leaves) {
  std::uint64_t refused = 0;
  std::uint64_t helped = 0;
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    const Program program = on_path(seed, leaves);
    SCOPED_TRACE(story_of(seed, program));
    // What else is wrong with the contour is not a matter of its entry.
    Program across = program;
    (leaves ? across.deselection : across.mode.selection) = Selection::direct;
    if (compensate(across).stopped) continue;
    const Outcome outcome = compensate(program);
    if (!outcome.stopped || outcome.error()->code != Code::selection_block_too_short) continue;
    ++refused;
    if (expect_useful(program, *outcome.error())) ++helped;
  }
  ::testing::Test::RecordProperty("refused", std::to_string(refused));
  ::testing::Test::RecordProperty("helped", std::to_string(helped));
  EXPECT_GT(refused, samples() / 5);
  EXPECT_GT(helped, refused * 19 / 20);
}

TEST(EveryProposedEntry, IsAcceptedAndClearUnderG236) { expect_useful_on_path(false); }
TEST(EveryProposedExit, IsAcceptedAndClearUnderG236) { expect_useful_on_path(true); }

// What is wrong with the way in or out of a contour that can be machined otherwise.
enum class Fault { circular_approach, circular_retract, tangential_approach, tangential_retract };

bool is_of_exit(Fault fault) {
  return fault == Fault::circular_retract || fault == Fault::tangential_retract;
}

Arc half_circle(const Point& start, const Point& end, bool clockwise) {
  return {.start = start, .end = end, .center = (start + end) / 2, .sweep = clockwise ? -pi : pi};
}

// A circle where only a line may be, or G05 from (to) a point on the tangent.
Program with_fault(std::uint64_t seed, Fault fault) {
  Random random(seed);
  Program program;
  program.mode = random_mode(random);
  const Contour contour = random_clean_contour(random, flavors[random.below(4)], program.mode,
                                               random.chance(0.7) ? 2 : 6);
  program.mode.selection = random.chance(0.5) ? Selection::direct : Selection::indirect;
  program.deselection = random.chance(0.5) ? Selection::direct : Selection::indirect;
  program.contour = contour.blocks;
  program.start = contour.approach.start;
  program.way_in = {contour.approach};
  program.way_out = {contour.retract};
  const double length = program.mode.tool_radius * random.between(0.05, 6);
  const double turn = random.between(-pi, pi);
  const Vector aside = length * Vector(std::cos(turn), std::sin(turn));
  const Point begin = contour.approach.end;
  const Point end = contour.retract.start;
  switch (fault) {
    case Fault::circular_approach:
      program.start = begin + aside;
      program.way_in = {half_circle(program.start, begin, random.chance(0.5))};
      break;
    case Fault::circular_retract:
      program.way_out = {half_circle(end, end + aside, random.chance(0.5))};
      break;
    case Fault::tangential_approach: {
      const Vector along = start_tangent(contour.blocks.front());
      const double side = program.mode.side == Side::left ? 1 : -1;
      program.start =
          begin + side * program.mode.tool_radius * Vector(-along.y(), along.x()) + length * along;
      program.way_in = {Line{.start = program.start, .end = begin}};
      program.tangential_in = true;
      break;
    }
    case Fault::tangential_retract: {
      const Vector along = end_tangent(contour.blocks.back());
      const double side = program.mode.side == Side::left ? 1 : -1;
      const Point target =
          end + side * program.mode.tool_radius * Vector(-along.y(), along.x()) - length * along;
      program.way_out = {Line{.start = end, .end = target}};
      program.tangential_out = true;
      break;
    }
  }
  return program;
}

// The program with the sound ways of its contour in place of those at fault. They end at the
// contour; a transition of G139 might reach farther.
Program without_fault(const Program& program, const Contour& contour) {
  Program sound = program;
  sound.start = contour.approach.start;
  sound.way_in = {contour.approach};
  sound.way_out = {contour.retract};
  sound.tangential_in = sound.tangential_out = false;
  sound.mode.selection = sound.deselection = Selection::direct;
  return sound;
}

void expect_useful_with(Fault fault, Code code) {
  std::uint64_t refused = 0;
  std::uint64_t helped = 0;
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    const Program program = with_fault(seed, fault);
    SCOPED_TRACE(story_of(seed, program));
    const Outcome outcome = compensate(program);
    if (!outcome.stopped || outcome.error()->code != code) continue;
    // What else is wrong with the contour is not a matter of its ways.
    const Point begin = start_of(program.contour.front());
    const Point end = end_of(program.contour.back());
    const Contour straight{.approach = {.start = begin + Vector(-1, 3), .end = begin},
                           .retract = {.start = end, .end = end + Vector(3, -1)}};
    if (compensate(without_fault(program, straight)).stopped) continue;
    ++refused;
    ASSERT_TRUE(outcome.error()->entry_help);
    EXPECT_EQ(outcome.error()->entry_help->leaves, is_of_exit(fault));
    EXPECT_EQ(outcome.error()->entry_help->needed_length, 0);
    if (expect_useful(program, *outcome.error())) ++helped;
  }
  ::testing::Test::RecordProperty("refused", std::to_string(refused));
  ::testing::Test::RecordProperty("helped", std::to_string(helped));
  EXPECT_GT(refused, samples() / 5);
  EXPECT_GT(helped, refused * 9 / 10) << helped << " of " << refused;
}

TEST(EveryProposedEntry, IsAcceptedAndClearInPlaceOfACircle) {
  expect_useful_with(Fault::circular_approach, Code::circular_selection_block);
}
TEST(EveryProposedExit, IsAcceptedAndClearInPlaceOfACircle) {
  expect_useful_with(Fault::circular_retract, Code::circular_deselection_block);
}
TEST(EveryProposedEntry, IsAcceptedAndClearUnderG05) {
  expect_useful_with(Fault::tangential_approach, Code::tangential_start_on_tangent);
}
TEST(EveryProposedExit, IsAcceptedAndClearUnderG05) {
  expect_useful_with(Fault::tangential_retract, Code::tangential_start_on_tangent);
}

// A star of lines about the origin, selected from anywhere near.
Program closed(std::uint64_t seed) {
  Random random(seed);
  Program program;
  program.mode = random_mode(random);
  program.mode.selection = Selection::inside_corner;
  const double radius = program.mode.tool_radius;
  const bool inside = random.chance(0.6);
  const double hand = (program.mode.side == Side::left) == inside ? 1 : -1;
  const std::size_t count = 3 + random.below(6);
  const double first = random.between(-pi, pi);
  std::vector<Point> corners;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = first + hand * 2 * pi * (static_cast<double>(k) + random.between(0, 0.3)) /
                                     static_cast<double>(count);
    const double away = radius * random.between(5, 12);
    corners.emplace_back(away * std::cos(angle), away * std::sin(angle));
  }
  for (std::size_t k = 0; k < count; ++k)
    program.contour.emplace_back(Line{.start = corners[k], .end = corners[(k + 1) % count]});
  const Vector aside(random.between(-4, 4), random.between(-4, 4));
  program.start = corners[0] + radius * aside;
  program.way_in = {Line{.start = program.start, .end = corners[0]}};
  program.way_out = {Line{.start = corners[0], .end = Point(20 * radius, 20 * radius)}};
  return program;
}

TEST(EveryProposedEntry, IsAcceptedAndClearUnderG238) {
  std::uint64_t refused = 0;
  std::uint64_t helped = 0;
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    const Program program = closed(seed);
    SCOPED_TRACE(story_of(seed, program));
    const Outcome outcome = compensate(program);
    if (!outcome.stopped) continue;
    const Diagnostic& error = *outcome.error();
    if (error.code != Code::selection_point_too_near &&
        error.code != Code::approach_crosses_contour &&
        error.code != Code::inside_corner_angle_too_large) {
      EXPECT_FALSE(error.entry_help);
      continue;
    }
    ++refused;
    if (!expect_useful(program, error)) continue;
    ++helped;
    const Point legal = in_plane(*error.entry_help->legal, program.mode.plane);
    for (const Segment& wall : program.contour)
      ASSERT_GE(slow_distance(legal, wall), program.mode.tool_radius - 1e-9);
  }
  ::testing::Test::RecordProperty("refused", std::to_string(refused));
  ::testing::Test::RecordProperty("helped", std::to_string(helped));
  EXPECT_GT(refused, samples() / 4);
  EXPECT_GT(helped, refused / 2);
}

// Loops go, but none of the start does: it has no room.
TEST(EveryProposedEntry, IsAcceptedAndClearInAnInsideCorner) {
  std::uint64_t refused = 0;
  std::uint64_t helped = 0;
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    Program program = closed(seed);
    program.mode.selection = program.deselection = Selection::direct;
    program.mode.masking = Masking::on;
    program.mode.options.remove_masked_blocks = true;
    SCOPED_TRACE(story_of(seed, program));
    const Outcome outcome = compensate(program);
    if (!outcome.stopped) continue;
    ++refused;
    if (!expect_useful(program, *outcome.error())) continue;
    ++helped;
    const auto& proposals = outcome.error()->entry_help->proposals;
    ASSERT_EQ(proposals.size(), 1U);
    EXPECT_EQ(proposals[0].shape, EntryProposal::Shape::inside_corner);
  }
  ::testing::Test::RecordProperty("refused", std::to_string(refused));
  ::testing::Test::RecordProperty("helped", std::to_string(helped));
  EXPECT_GT(refused, samples() / 5);
  EXPECT_GT(helped, refused / 3);
}

// A convex pocket that is entered and left in the middle of a side by quarter circles, which are
// too small now and then.
Program pocket(std::uint64_t seed) {
  Random random(seed);
  Program program;
  program.mode = random_mode(random);
  program.mode.masking = Masking::on;
  program.mode.options.remove_masked_blocks = true;
  program.compensator = {};
  const double radius = program.mode.tool_radius;
  const double hand = program.mode.side == Side::left ? 1 : -1;
  const std::size_t count = 4 + random.below(5);
  const double first = random.between(-pi, pi);
  const double away = radius * random.between(4, 12);
  std::vector<Point> corners;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = first + hand * 2 * pi * (static_cast<double>(k) + random.between(0, 0.3)) /
                                     static_cast<double>(count);
    corners.emplace_back(away * std::cos(angle), away * std::sin(angle));
  }
  const Point begin = (corners[0] + corners[1]) / 2;
  const Vector along = (corners[1] - corners[0]).normalized();
  const Vector inward = hand * Vector(-along.y(), along.x());
  const double in = radius * random.between(0.2, 1.4);
  const double out = radius * random.between(0.2, 2.5);
  const Point center_in = begin + in * inward;
  const Point center_out = begin + out * inward;
  const Point on = center_in - in * along;
  const Point off = center_out + out * along;
  program.start = center_in;
  program.way_in = {Line{.start = center_in, .end = on}};
  program.contour.emplace_back(
      Arc{.start = on, .end = begin, .center = center_in, .sweep = hand * pi / 2});
  Point at = begin;
  for (std::size_t k = 1; k <= count; ++k) {
    program.contour.emplace_back(Line{.start = at, .end = corners[k % count]});
    at = corners[k % count];
  }
  program.contour.emplace_back(Line{.start = at, .end = begin});
  program.contour.emplace_back(
      Arc{.start = begin, .end = off, .center = center_out, .sweep = hand * pi / 2});
  program.leads_out = 1;
  program.way_out = {Line{.start = off, .end = center_out}};
  return program;
}

TEST(EveryProposedEntry, TakesThePlaceOfLeadsThatAreTooSmall) {
  std::uint64_t refused = 0;
  std::uint64_t helped = 0;
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    const Program program = pocket(seed);
    SCOPED_TRACE(story_of(seed, program));
    const Outcome outcome = compensate(program);
    if (!outcome.stopped) continue;
    ++refused;
    if (expect_useful(program, *outcome.error())) ++helped;
  }
  ::testing::Test::RecordProperty("refused", std::to_string(refused));
  ::testing::Test::RecordProperty("helped", std::to_string(helped));
  EXPECT_GT(refused, samples() / 4);
  EXPECT_GT(helped, refused / 2);
}

}  // namespace
}  // namespace trc::support
