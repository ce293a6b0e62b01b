#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// G238 on random closed contours and SPLIT on random ones. Each has a seed of its
// own, which a failure prints; TRC_TEST_LONG=1 takes 100,000 contours a property.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

std::uint64_t samples() { return is_long_run() ? 100'000 : 1'500; }

struct Sample {
  TrcMode mode{};
  Contour contour{};
};

double size_of(const Contour& contour) {
  double size = 1 + contour.approach.start.norm();
  for (const Segment& block : contour.blocks) size = std::max(size, point_at(block, 1).norm());
  return size;
}

// A block from `start` to `end` that bends by `sweep`; 0 is a line.
Segment bent(const Point& start, const Point& end, double sweep) {
  if (sweep == 0) return Line{.start = start, .end = end};
  const Vector chord = end - start;
  const Vector left{-chord.y(), chord.x()};
  const Point center = (start + end) / 2 + left / (2 * std::tan(sweep / 2));
  return Arc{.start = start, .end = end, .center = center, .sweep = sweep};
}

// A star about the origin of 3 … 9 lines and arcs, selected from inside or outside;
// whether the tool fits and the start is far enough is left to chance.
Sample closed_sample(std::uint64_t seed) {
  Random random(seed);
  Sample result;
  result.mode = random_mode(random);
  result.mode.selection = Selection::inside_corner;
  const double radius = result.mode.tool_radius;
  const bool inside = random.chance(0.7);
  const double turn = (result.mode.side == Side::left) == inside ? 1 : -1;
  const std::size_t count = 3 + random.below(7);
  const double first = random.between(-pi, pi);
  std::vector<Point> corners;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = first + turn * 2 * pi * (static_cast<double>(k) + random.between(0, 0.4)) /
                                     static_cast<double>(count);
    const double away = radius * random.between(4, 14);
    corners.emplace_back(away * std::cos(angle), away * std::sin(angle));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const bool line = k == 0 || random.chance(0.65);
    const double sweep = line ? 0 : random.between(0.05, 1.2) * (random.chance(0.5) ? 1 : -1);
    result.contour.blocks.push_back(bent(corners[k], corners[(k + 1) % count], sweep));
  }
  const auto free_point = [&] {
    const double away = inside ? random.between(0, 0.2) : random.between(1.5, 2);
    return Point(away * corners[0] + radius * Vector(random.between(-1, 1), random.between(-1, 1)));
  };
  result.contour.approach = {.start = free_point(), .end = corners[0]};
  result.contour.retract = {.start = corners[0], .end = free_point()};
  return result;
}

template <class Claim>
void for_each_closed_contour(const Claim& claim) {
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    const Sample tested = closed_sample(seed);
    std::ostringstream story;
    story << "seed " << seed << ", " << text_of(tested.mode) << '\n' << tested.contour;
    SCOPED_TRACE(story.str());
    claim(tested);
  }
}

// Below 180 degrees an inside corner, on the tool side.
double angle_between(const Vector& before, const Vector& after, Side side) {
  const double turn =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  return pi - (side == Side::left ? turn : -turn);
}

double closing_angle(const Sample& tested) {
  return angle_between(end_tangent(tested.contour.blocks.back()),
                       start_tangent(tested.contour.blocks.front()), tested.mode.side);
}

// G138 on the same contour with its first block travelled once more has the closing
// corner in its middle, where the slow computation knows it.
std::vector<SlowBlock> inside_corner_path(const Contour& contour, const SlowOutcome& twice) {
  const auto at = [&](std::size_t ordinal) {
    return std::find_if(twice.path.begin(), twice.path.end(), [&](const SlowBlock& block) {
      return block.ordinal == ordinal && block.origin == Origin::programmed;
    });
  };
  const auto first = at(1);
  const auto again = at(contour.blocks.size() + 1);
  const SlowPoint corner = again->start;
  std::vector<SlowBlock> expected(first, again);
  expected.front().start = corner;
  SlowBlock way_in;
  way_in.start = wide(contour.approach.start);
  way_in.end = corner;
  SlowBlock way_out;
  way_out.start = corner;
  way_out.end = wide(contour.retract.end);
  expected.insert(expected.begin(), way_in);
  expected.push_back(way_out);
  return expected;
}

// Rule 3.5.
TEST(EveryClosedContour, BeginsAndEndsInTheInsideCorner) {
  std::size_t inside = 0;
  std::size_t outside = 0;
  for_each_closed_contour([&](const Sample& tested) {
    const double angle = closing_angle(tested);
    if (std::abs(angle - pi) < 1e-3 || angle < 1e-2 || angle > 2 * pi - 1e-2) return;
    TrcMode direct = tested.mode;
    direct.selection = Selection::direct;
    Contour travelled = tested.contour;
    if (angle < pi) {
      travelled.blocks.push_back(travelled.blocks.front());
      const Line& again = std::get<Line>(travelled.blocks.back());
      travelled.retract = {.start = again.end, .end = again.end + (again.end - again.start)};
    }
    const SlowOutcome judged = slow_trc(travelled, direct);
    if (judged.borderline) return;
    const Outcome outcome = compensate(tested.contour, tested.mode);
    if (!judged.faults.empty()) {
      EXPECT_TRUE(outcome.stopped) << text_of(outcome.blocks);
      return;
    }
    if (outcome.stopped) {
      // The first block is cut at both ends only here; the rest are rules of G238.
      static const std::set<Code> allowed{Code::selection_point_too_near,
                                          Code::approach_crosses_contour,
                                          Code::inside_corner_angle_too_large};
      const Diagnostic& error = *outcome.error();
      EXPECT_TRUE(allowed.contains(error.code) ||
                  (error.code == Code::line_reversed && error.source.number <= 1))
          << message_of(error);
      return;
    }
    EXPECT_EQ(outcome.blocks.size() > 2, true);
    const std::vector<SlowBlock> expected =
        angle < pi ? inside_corner_path(tested.contour, judged) : judged.path;
    EXPECT_EQ(geometric_difference(outcome.blocks, expected, 2e-7 * size_of(tested.contour)), "")
        << text_of(outcome.blocks);
    ++(angle < pi ? inside : outside);
  });
  EXPECT_GT(inside, samples() / 8);
  EXPECT_GT(outside, samples() / 100);
}

TEST(EveryClosedContour, IsConnectedBitForBit) {
  for_each_closed_contour([](const Sample& tested) {
    const Outcome outcome = compensate(tested.contour, tested.mode);
    EXPECT_EQ(first_gap(outcome.blocks), "");
    if (outcome.stopped) return;
    const auto path = moving(outcome.blocks);
    EXPECT_EQ(point_at(path.front().path, 0), tested.contour.approach.start);
    EXPECT_EQ(std::get<Line>(path.back().path).end, tested.contour.retract.end);
    if (closing_angle(tested) < pi - 1e-3) {
      EXPECT_EQ(std::get<Line>(path.front().path).end, std::get<Line>(path.back().path).start)
          << "the inside corner";
    }
  });
}

// Every block at R from its own programmed block, and the start as free as 90123 asks.
TEST(EveryClosedContour, KeepsItsRadius) {
  for_each_closed_contour([](const Sample& tested) {
    const Outcome outcome = compensate(tested.contour, tested.mode);
    if (outcome.stopped) return;
    const double radius = tested.mode.tool_radius;
    const double tolerance = 1e-9 * size_of(tested.contour);
    const double hand = tested.mode.side == Side::left ? 1 : -1;
    for (const CompensatedBlock& block : moving(outcome.blocks, 1e-6)) {
      if (block.origin != Origin::programmed) continue;
      const Segment& programmed =
          tested.contour.blocks.at(static_cast<std::size_t>(block.source.number) - 1);
      for (const double t : {0.0, 0.4, 1.0}) {
        const Point point = point_at(block.path, t);
        if (const auto* line = std::get_if<Line>(&programmed)) {
          const Vector along = (line->end - line->start).normalized();
          const Vector left{-along.y(), along.x()};
          ASSERT_NEAR(hand * left.dot(point - line->start), radius, tolerance) << text_of(block);
          continue;
        }
        const auto& arc = std::get<Arc>(programmed);
        const double expected =
            (arc.start - arc.center).norm() - (arc.sweep * hand > 0 ? radius : -radius);
        ASSERT_NEAR((point - arc.center).norm(), expected, 100 * tolerance) << text_of(block);
      }
    }
    for (const Segment& block : tested.contour.blocks)
      EXPECT_GE(slow_distance(tested.contour.approach.start, block), radius - 1e-4);
  });
}

TEST(EveryClosedContour, IsMirroredWithTheOtherSide) {
  for_each_closed_contour([](const Sample& tested) {
    const Motion mirror{.mirrored = true};
    TrcMode mode = tested.mode;
    mode.side = other(mode.side);
    const Outcome here = compensate(tested.contour, tested.mode);
    const Outcome there = compensate(mirror(tested.contour), mode);
    ASSERT_EQ(here.stopped, there.stopped);
    EXPECT_EQ(difference(there.blocks, here.blocks, mirror, 1e-8 * size_of(tested.contour)), "");
  });
}

TEST(EveryClosedContour, TurnsAndShiftsWithTheProgram) {
  for_each_closed_contour([](const Sample& tested) {
    if (slow_trc(tested.contour, tested.mode).borderline) return;
    const Motion motion{.turn = std::fmod(tested.contour.approach.end.x(), 3),
                        .shift = {130, -270}};
    const Outcome here = compensate(tested.contour, tested.mode);
    const Outcome there = compensate(motion(tested.contour), tested.mode);
    ASSERT_EQ(here.stopped, there.stopped);
    EXPECT_EQ(difference(there.blocks, here.blocks, motion, 1e-6 * (size_of(tested.contour) + 400)),
              "");
  });
}

TEST(EveryClosedContour, IsTheSameInEveryBatching) {
  for_each_closed_contour([](const Sample& tested) {
    Feeding feeding;
    feeding.texts = [](std::size_t ordinal) {
      return std::vector<std::string>(ordinal % 3, "M" + std::to_string(ordinal));
    };
    feeding.tracking = [](std::size_t ordinal) { return static_cast<double>(ordinal) * 1.25; };
    const Outcome single = compensate(tested.contour, tested.mode, feeding);
    for (const std::size_t batch : {1U, 0U, 3U}) {
      feeding.batch = batch;
      EXPECT_TRUE(same(compensate(tested.contour, tested.mode, feeding), single)) << batch;
    }
  });
}

// SPLIT_PATH at both ends with lengths of up to a few radii.
Sample split_sample(std::uint64_t seed) {
  Random random(seed);
  Sample result;
  result.mode = random_mode(random);
  result.contour =
      random_clean_contour(random, all_flavors[seed % std::size(all_flavors)], result.mode, 5);
  SplitOption& split = result.mode.options.split;
  split.where = static_cast<SplitOption::Where>(1 + random.below(3));
  split.along_path = true;
  split.distance_1 = result.mode.tool_radius * random.between(0.01, 4);
  split.feed_1 = 200;
  if (random.chance(0.5)) {
    split.distance_2 = result.mode.tool_radius * random.between(0.01, 4);
    split.feed_2 = 50;
  }
  return result;
}

template <class Claim>
void for_each_split(const Claim& claim) {
  for (std::uint64_t seed = 1; seed <= samples() && !::testing::Test::HasFailure(); ++seed) {
    const Sample tested = split_sample(9'000'000 + seed);
    std::ostringstream story;
    story << "seed " << seed << ", " << text_of(tested.mode) << ", "
          << tested.mode.options.split.distance_1 << ' ' << tested.mode.options.split.distance_2
          << '\n'
          << tested.contour;
    SCOPED_TRACE(story.str());
    claim(tested);
  }
}

struct Part {
  double length = 0;
  double feed = 0;  // 0: as programmed
};

// Rule 7.2 and D-19: from the contour outwards.
std::vector<Part> parts_of(const SplitOption& split, double length) {
  if (split.distance_2 == 0) {
    if (split.distance_1 > length) return {{length, 0}};
    return {{split.distance_1, split.feed_1}, {length - split.distance_1, 0}};
  }
  if (split.distance_2 > length) return {{length, 0}};
  if (split.distance_1 + split.distance_2 > length)
    return {{split.distance_2, split.feed_2}, {length - split.distance_2, 0}};
  return {{split.distance_2, split.feed_2},
          {split.distance_1, split.feed_1},
          {length - split.distance_1 - split.distance_2, 0}};
}

std::vector<CompensatedBlock> with_role(const Outcome& outcome, Origin origin,
                                        std::int64_t number) {
  std::vector<CompensatedBlock> result;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == origin && block.source.number == number) result.push_back(block);
  return result;
}

TEST(EverySplit, DividesTheBlockNextToTheContour) {  // D-19
  std::size_t divided = 0;
  for_each_split([&](const Sample& tested) {
    const SplitOption& split = tested.mode.options.split;
    TrcMode whole_mode = tested.mode;
    whole_mode.options.split = {};
    const Outcome whole = compensate(tested.contour, whole_mode);
    const Outcome outcome = compensate(tested.contour, tested.mode);
    ASSERT_FALSE(outcome.stopped);
    EXPECT_EQ(first_gap(outcome.blocks), "");
    const auto last = static_cast<std::int64_t>(tested.contour.blocks.size()) + 1;
    for (const bool approach : {true, false}) {
      const Origin origin = approach ? Origin::approach : Origin::retract;
      const std::int64_t number = approach ? 0 : last;
      const auto one = with_role(whole, origin, number);
      if (one.empty()) continue;  // G239 has no retract block
      const Segment& near = approach ? tested.contour.blocks.front() : tested.contour.blocks.back();
      const double angle =
          approach ? angle_between(start_tangent(tested.contour.approach), start_tangent(near),
                                   tested.mode.side)
                   : angle_between(end_tangent(near), start_tangent(tested.contour.retract),
                                   tested.mode.side);
      const bool reversal = std::abs(std::sin(angle)) < 1e-3 && std::cos(angle) > 0;  // D-05
      if (std::abs(angle - pi) < 1e-3 || reversal) continue;
      const bool wanted =
          split.where == SplitOption::Where::combined ||
          split.where == (approach ? SplitOption::Where::pre : SplitOption::Where::post);
      // Above 180 degrees the block beside the contour may be one TRC has inserted.
      const Line& line = std::get<Line>(approach ? one.front().path : one.back().path);
      const double length = (line.end - line.start).norm();
      std::vector<Part> expected{{length, 0}};
      if (wanted && angle < pi) expected = parts_of(split, length);
      if (approach) std::reverse(expected.begin(), expected.end());
      const auto actual = with_role(outcome, origin, number);
      ASSERT_EQ(actual.size(), expected.size() + one.size() - 1) << text_of(outcome.blocks);
      const std::size_t skipped = approach ? 0 : one.size() - 1;
      Point at = line.start;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const Line& part = std::get<Line>(actual[skipped + k].path);
        at += expected[k].length / length * (line.end - line.start);
        EXPECT_NEAR((part.end - at).norm(), 0, 1e-9 * size_of(tested.contour));
        const double programmed = one.front().feed;
        EXPECT_EQ(actual[skipped + k].feed, expected[k].feed > 0 ? expected[k].feed : programmed);
      }
      divided += expected.size() > 1 ? 1 : 0;
    }
    // Nothing else changes.
    const auto rest = [](const Outcome& of) {
      std::vector<CompensatedBlock> blocks;
      for (const CompensatedBlock& block : moving(of.blocks))
        if (block.origin == Origin::programmed || block.origin == Origin::transition)
          blocks.push_back(block);
      return blocks;
    };
    EXPECT_EQ(text_of(rest(outcome)), text_of(rest(whole)));
  });
  EXPECT_GT(divided, samples() / 4);
}

TEST(EverySplit, IsMirroredAndTurnedAndTheSameInEveryBatching) {
  for_each_split([](const Sample& tested) {
    const Outcome here = compensate(tested.contour, tested.mode);
    const Motion mirror{.mirrored = true};
    TrcMode mode = tested.mode;
    mode.side = other(mode.side);
    EXPECT_EQ(difference(compensate(mirror(tested.contour), mode).blocks, here.blocks, mirror,
                         1e-8 * size_of(tested.contour)),
              "");
    if (!slow_trc(tested.contour, tested.mode).borderline) {
      const Motion motion{.turn = 1.1, .shift = {-40, 75}};
      EXPECT_EQ(difference(compensate(motion(tested.contour), tested.mode).blocks, here.blocks,
                           motion, 1e-6 * (size_of(tested.contour) + 100)),
                "");
    }
    for (const std::size_t batch : {1U, 0U, 3U}) {
      Feeding feeding;
      feeding.batch = batch;
      EXPECT_TRUE(same(compensate(tested.contour, tested.mode, feeding), here)) << batch;
    }
  });
}

}  // namespace
}  // namespace trc::support
