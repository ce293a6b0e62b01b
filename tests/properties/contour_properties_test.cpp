#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// What must hold for every contour, on random ones. Each contour has a seed of
// its own, which a failure prints; TRC_TEST_LONG=1 takes 100,000 contours or
// more a property.

namespace trc::support {
namespace {

constexpr std::size_t longest = 9;

std::size_t contours_per_flavor() { return is_long_run() ? 17'000 : 300; }

// A contour and a mode from one seed.
struct Sample {
  TrcMode mode{};
  Contour contour{};
};

Sample sample(std::uint64_t seed, Flavor flavor) {
  Random random(seed);
  Sample result;
  result.mode = random_mode(random);
  result.contour = random_contour(random, flavor, result.mode, longest);
  return result;
}

std::string story(std::uint64_t seed, const Sample& sample) {
  std::ostringstream text;
  text << "seed " << seed << ", " << text_of(sample.mode) << '\n' << sample.contour;
  return text.str();
}

Point first_of(const Segment& segment) {
  return std::visit([](const auto& shape) { return shape.start; }, segment);
}
Point last_of(const Segment& segment) {
  return std::visit([](const auto& shape) { return shape.end; }, segment);
}

// Largest coordinate or radius a contour brings into the arithmetic, mm.
double size_of(const Contour& contour) {
  double size = std::max(contour.approach.start.norm(), contour.retract.end.norm());
  for (const Segment& block : contour.blocks) {
    size = std::max(size, last_of(block).norm());
    if (const auto* arc = std::get_if<Arc>(&block)) size = std::max(size, arc->center.norm());
  }
  return 1 + size;
}

// A programmed block that is still travelled: one trimmed to nothing may stay as
// an empty line (D-13).
bool is_programmed(const CompensatedBlock& block) {
  return block.origin == Origin::programmed &&
         (is_arc(block.path) || (first_of(block.path) - last_of(block.path)).norm() > 1e-6);
}
bool is_inserted(const CompensatedBlock& block) { return block.origin == Origin::transition; }

const Segment& programmed_of(const Contour& contour, const CompensatedBlock& block) {
  return contour.blocks.at(static_cast<std::size_t>(block.source.number) - 1);
}

// Travel of the third main axis and of a tracking axis, and up to three texts
// after every block.
Feeding full_feeding() {
  return {.texts =
              [](std::size_t ordinal) {
                std::vector<std::string> texts;
                for (std::size_t k = 0; k < (ordinal * 7 + 2) % 4; ++k)
                  texts.push_back("M" + std::to_string(ordinal * 10 + k));
                return texts;
              },
          .third = [](std::size_t ordinal) { return static_cast<double>(ordinal / 2) * -0.5; },
          .tracking = [](std::size_t ordinal) { return static_cast<double>(ordinal) * 1.25; }};
}

class EveryContour : public ::testing::TestWithParam<Flavor> {
 protected:
  // Calls `claim(sample)` for many contours until one fails it.
  template <class Claim>
  void for_each_contour(const Claim& claim) const {
    const auto flavor_seed = (1 + static_cast<std::uint64_t>(GetParam())) * 1'000'000;
    for (std::size_t k = 0; k < contours_per_flavor() && !HasFailure(); ++k) {
      const Sample tested = sample(flavor_seed + k, GetParam());
      SCOPED_TRACE(story(flavor_seed + k, tested));
      claim(tested);
    }
  }
};

TEST_P(EveryContour, IsConnectedBitForBit) {
  for_each_contour([](const Sample& tested) {
    const Outcome outcome = compensate(tested.contour, tested.mode, full_feeding());
    EXPECT_EQ(first_gap(outcome.blocks), "");
    if (outcome.stopped) return;
    ASSERT_FALSE(outcome.blocks.empty());
    const auto path = moving(outcome.blocks);
    EXPECT_EQ(first_of(path.front().path), tested.contour.approach.start);
    EXPECT_EQ(last_of(path.back().path), tested.contour.retract.end);
  });
}

TEST_P(EveryContour, RunsOneRadiusBesideItsBlocks) {
  for_each_contour([](const Sample& tested) {
    const double radius = tested.mode.tool_radius;
    const double hand = tested.mode.side == Side::left ? 1 : -1;
    const double tolerance = 1e-9 * size_of(tested.contour);
    for (const CompensatedBlock& block : compensate(tested.contour, tested.mode).blocks) {
      if (!is_programmed(block)) continue;
      const Segment& programmed = programmed_of(tested.contour, block);
      ASSERT_EQ(is_arc(block.path), is_arc(programmed));
      for (const double t : {0.0, 0.3, 0.5, 0.7, 1.0}) {
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
      if (is_arc(block.path)) {
        ASSERT_NEAR((point_at(block.path, 1) - last_of(block.path)).norm(), 0, 100 * tolerance)
            << text_of(block);
      }
    }
  });
}

TEST_P(EveryContour, KeepsItsRadiusFromEveryCornerItGoesRound) {
  for_each_contour([](const Sample& tested) {
    const double radius = tested.mode.tool_radius;
    const double tolerance = 1e-9 * size_of(tested.contour);
    for (const CompensatedBlock& block : compensate(tested.contour, tested.mode).blocks) {
      if (!is_inserted(block)) continue;
      const Point corner = last_of(programmed_of(tested.contour, block));
      for (int k = 0; k <= 20; ++k)
        ASSERT_GE((point_at(block.path, k / 20.0) - corner).norm(), radius - tolerance)
            << text_of(block);
      if (tested.mode.transition != Transition::circular) continue;
      ASSERT_TRUE(is_arc(block.path));
      ASSERT_NEAR((std::get<Arc>(block.path).center - corner).norm(), 0, tolerance);
      ASSERT_NEAR((first_of(block.path) - corner).norm(), radius, tolerance);
    }
  });
}

TEST_P(EveryContour, NeverRunsAgainstItsProgrammedDirection) {
  for_each_contour([](const Sample& tested) {
    for (const CompensatedBlock& block : compensate(tested.contour, tested.mode).blocks) {
      if (!is_programmed(block)) continue;
      const Segment& programmed = programmed_of(tested.contour, block);
      if (const auto* line = std::get_if<Line>(&programmed)) {
        const Vector along = (line->end - line->start).normalized();
        ASSERT_GE(along.dot(last_of(block.path) - first_of(block.path)), -1e-4) << text_of(block);
        continue;
      }
      const double wanted = std::get<Arc>(programmed).sweep;
      const double sweep = std::get<Arc>(block.path).sweep;
      const double slack = 1e-4 / (first_of(block.path) - std::get<Arc>(block.path).center).norm();
      ASSERT_LE(std::abs(sweep), std::abs(wanted) + 1e-9) << text_of(block);
      ASSERT_GE(sweep * (wanted > 0 ? 1 : -1), -slack) << text_of(block);
    }
  });
}

TEST_P(EveryContour, AgreesWithTheSlowComputation) {
  std::size_t finished = 0;
  std::size_t refused = 0;
  std::size_t open = 0;
  for_each_contour([&](const Sample& tested) {
    const SlowOutcome expected = slow_trc(tested.contour, tested.mode);
    if (expected.borderline) {
      ++open;
      return;
    }
    const Outcome outcome = compensate(tested.contour, tested.mode);
    const double tolerance = 2e-7 * size_of(tested.contour);
    if (expected.faults.empty()) {
      ++finished;
      ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
      ASSERT_EQ(difference(outcome.blocks, expected.path, tolerance), "")
          << text_of(outcome.blocks);
      return;
    }
    ++refused;
    ASSERT_TRUE(outcome.stopped) << "expected " << static_cast<int>(expected.faults.front().code)
                                 << " at block " << expected.faults.front().ordinal << '\n'
                                 << text_of(outcome.blocks);
    const Diagnostic& error = *outcome.error();
    const auto named =
        std::any_of(expected.faults.begin(), expected.faults.end(), [&](const SlowFault& fault) {
          return fault.code == error.code &&
                 static_cast<std::int64_t>(fault.ordinal) == error.source.number;
        });
    ASSERT_TRUE(named) << static_cast<int>(error.code) << " at block " << error.source.number
                       << ", expected " << static_cast<int>(expected.faults.front().code)
                       << " at block " << expected.faults.front().ordinal;
    // What was delivered before the refusal is the beginning of the right path.
    const auto before = moving(outcome.blocks, 4 * tolerance);
    std::vector<SlowBlock> beginning;
    for (const SlowBlock& block : expected.path) {
      const double x = static_cast<double>(block.end.x - block.start.x);
      const double y = static_cast<double>(block.end.y - block.start.y);
      const bool has_length = std::hypot(x, y) > 4 * tolerance || std::abs(block.sweep) > 3;
      if (has_length && beginning.size() < before.size()) beginning.push_back(block);
    }
    ASSERT_EQ(difference(before, beginning, tolerance), "");
  });
  if (HasFailure()) return;
  // The judge must have been asked in earnest.
  EXPECT_GT(finished, contours_per_flavor() / 4);
  EXPECT_LT(open, contours_per_flavor() / 2);
  RecordProperty("refused", static_cast<int>(refused));
}

TEST_P(EveryContour, IsAcceptedWhenNothingIsViolated) {
  const auto flavor_seed = (1 + static_cast<std::uint64_t>(GetParam())) * 3'000'000;
  for (std::size_t k = 0; k < contours_per_flavor() / 15 && !HasFailure(); ++k) {
    Random random(flavor_seed + k);
    Sample tested;
    tested.mode = random_mode(random);
    tested.contour = random_clean_contour(random, GetParam(), tested.mode, 15);
    SCOPED_TRACE(story(flavor_seed + k, tested));
    const Outcome outcome = compensate(tested.contour, tested.mode);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_TRUE(outcome.diagnostics.empty());
    EXPECT_EQ(first_gap(outcome.blocks), "");
  }
}

TEST_P(EveryContour, IsMirroredWithTheOtherSide) {
  for_each_contour([](const Sample& tested) {
    const Motion mirror{.mirrored = true};
    TrcMode mode = tested.mode;
    mode.side = other(mode.side);
    const Outcome here = compensate(tested.contour, tested.mode);
    const Outcome there = compensate(mirror(tested.contour), mode);
    ASSERT_EQ(here.stopped, there.stopped);
    EXPECT_EQ(difference(there.blocks, here.blocks, mirror, 1e-8 * size_of(tested.contour)), "");
  });
}

TEST_P(EveryContour, TurnsAndShiftsWithTheProgram) {
  for_each_contour([](const Sample& tested) {
    if (slow_trc(tested.contour, tested.mode).borderline) return;
    const double angle = std::fmod(tested.contour.approach.start.x() * 0.37 + 1, 3);
    const Motion motion{.turn = angle, .shift = {130, -270}};
    const Outcome here = compensate(tested.contour, tested.mode);
    const Outcome there = compensate(motion(tested.contour), tested.mode);
    ASSERT_EQ(here.stopped, there.stopped);
    EXPECT_EQ(difference(there.blocks, here.blocks, motion, 1e-6 * (size_of(tested.contour) + 400)),
              "");
  });
}

// Path and roles of a result, travelled from its end.
std::vector<CompensatedBlock> backwards(const std::vector<CompensatedBlock>& blocks,
                                        std::int64_t contour_blocks) {
  std::vector<CompensatedBlock> result;
  const std::vector<CompensatedBlock> path = moving(blocks);
  for (std::size_t k = path.size(); k-- > 0;) {
    CompensatedBlock block = path[k];
    const bool approach_itself = k == 0;
    const bool retract_itself = block.source.number == contour_blocks + 1;
    const bool inserted = !is_programmed(block) && !approach_itself && !retract_itself;
    block.source.number = contour_blocks + (inserted ? 0 : 1) - block.source.number;
    if (block.origin == Origin::approach)
      block.origin = Origin::retract;
    else if (block.origin == Origin::retract)
      block.origin = Origin::approach;
    block.path = reversed(block.path);
    result.push_back(block);
  }
  return result;
}

TEST_P(EveryContour, GivesTheSamePathBackwardsOnTheOtherSide) {
  for_each_contour([](const Sample& tested) {
    if (tested.mode.selection == Selection::without_block) return;
    if (slow_trc(tested.contour, tested.mode).borderline) return;
    TrcMode mode = tested.mode;
    mode.side = other(mode.side);
    const Outcome here = compensate(tested.contour, tested.mode);
    const Outcome there = compensate(reversed(tested.contour), mode);
    ASSERT_EQ(here.stopped, there.stopped);
    if (here.stopped) return;
    const auto count = static_cast<std::int64_t>(tested.contour.blocks.size());
    EXPECT_EQ(difference(there.blocks, backwards(here.blocks, count), Motion{},
                         2e-7 * size_of(tested.contour)),
              "");
  });
}

TEST_P(EveryContour, ComesBackUnchangedWithRadiusZero) {
  for_each_contour([](const Sample& tested) {
    TrcMode mode = tested.mode;
    mode.tool_radius = 0;
    const Outcome outcome = compensate(tested.contour, mode);
    ASSERT_FALSE(outcome.stopped);
    ASSERT_EQ(outcome.blocks.size(), tested.contour.blocks.size() + 2);
    for (std::size_t k = 0; k < tested.contour.blocks.size(); ++k) {
      const Segment& expected = tested.contour.blocks[k];
      const Segment& actual = outcome.blocks[k + 1].path;
      ASSERT_EQ(is_arc(actual), is_arc(expected));
      EXPECT_NEAR((last_of(actual) - last_of(expected)).norm(), 0, 1e-9);
      if (is_arc(actual)) {
        EXPECT_NEAR(std::get<Arc>(actual).sweep, std::get<Arc>(expected).sweep, 1e-9);
      }
    }
  });
}

TEST_P(EveryContour, IsTheSameInEveryPlane) {
  for_each_contour([](const Sample& tested) {
    const Outcome xy = compensate(tested.contour, tested.mode, full_feeding());
    for (const Plane plane : {Plane::zx, Plane::yz}) {
      TrcMode mode = tested.mode;
      mode.plane = plane;
      Outcome outcome = compensate(tested.contour, mode, full_feeding());
      for (CompensatedBlock& block : outcome.blocks) {
        EXPECT_EQ(block.plane, plane);
        block.plane = Plane::xy;
      }
      EXPECT_TRUE(same(outcome, xy));
    }
  });
}

TEST_P(EveryContour, IsTheSameInEveryBatching) {
  for_each_contour([](const Sample& tested) {
    Feeding feeding = full_feeding();
    const Outcome single = compensate(tested.contour, tested.mode, feeding);
    EXPECT_TRUE(same(compensate(tested.contour, tested.mode, feeding), single)) << "second run";
    for (const std::size_t batch : {0U, 2U, 3U, 5U}) {
      feeding.batch = batch;
      const Outcome batched = compensate(tested.contour, tested.mode, feeding);
      EXPECT_TRUE(same(batched, single)) << "batch of " << batch << '\n'
                                         << text_of(batched.blocks) << "single blocks\n"
                                         << text_of(single.blocks);
    }
  });
}

// Every option the short way may have to do with, at random, on and off.
TrcMode with_random_options(Random& random, TrcMode mode) {
  const auto at_random = [&] { return random.chance(0.25); };
  mode.masking = random.chance(0.5) ? Masking::on : Masking::off;
  mode.feed_adaptation = at_random() ? FeedAdaptation::on : FeedAdaptation::off;
  mode.tangfeed_minimum = at_random() ? mode.tool_radius : 0;
  TrcOptions& options = mode.options;
  options.remove_masked_blocks = random.chance(0.5);
  options.conv_cir_to_lin = at_random();
  options.kerf_masking = at_random();
  options.ignore_cont_damage = random.chance(0.5);
  options.ext_angle_block_intersection = at_random();
  options.tangential_limit = at_random() ? 0.5 : 3;
  options.perpendicular_radius_change = at_random();
  options.gen_cir_block_in_corner = at_random();
  options.suppress_trc = random.chance(0.1);
  if (at_random())
    options.split = {.where = SplitOption::Where::combined,
                     .along_path = true,
                     .distance_1 = 0.5 * mode.tool_radius,
                     .feed_1 = 100};
  return mode;
}

// Blocks in the middle of a contour take the short way (ShortWay) wherever nothing is about them:
// up to a violation, a text and what each batch leaves. All passes put out the same, bit for bit,
// whatever is on, into loop removal and out of it.
TEST_P(EveryContour, IsTheSameTheShortWay) {
  constexpr std::size_t long_ones = 40;
  const auto flavor_seed = (101 + static_cast<std::uint64_t>(GetParam())) * 1'000'000;
  for (std::uint64_t seed = flavor_seed; seed < flavor_seed + contours_per_flavor(); ++seed) {
    Random random(seed);
    Sample tested{.mode = random_mode(random)};
    const auto& make = seed % 8 == 0 ? random_clean_contour : random_contour;
    tested.contour = make(random, GetParam(), tested.mode, long_ones);
    if (seed % 2 == 0) tested.mode = with_random_options(random, tested.mode);
    Feeding feeding = full_feeding();
    feeding.texts = [](std::size_t ordinal) {
      return std::vector<std::string>(ordinal % 17 == 11 ? 1 : 0, "M7");
    };
    if (seed % 3 == 0) feeding.third = feeding.tracking = nullptr;
    feeding.compensator.limits.look_ahead_blocks = seed % 5 == 0 ? 6 : 0;
    feeding.compensator.inverse_path = seed % 7 == 0;
    try {
      feeding.compensator.engine = Engine::passes;
      const Outcome passes = compensate(tested.contour, tested.mode, feeding);
      for (const Engine engine : {Engine::short_way, Engine::automatic})
        for (const std::size_t batch : {1U, 0U, 4U}) {
          feeding.compensator.engine = engine;
          feeding.batch = batch;
          const Outcome outcome = compensate(tested.contour, tested.mode, feeding);
          ASSERT_TRUE(same(outcome, passes)) << story(seed, tested) << "batch of " << batch << '\n'
                                             << text_of(outcome.blocks) << "all passes\n"
                                             << text_of(passes.blocks);
        }
    } catch (const std::exception& fault) {
      FAIL() << story(seed, tested) << fault.what();
    }
  }
}

TEST_P(EveryContour, HoldsAtMostTwoRelevantBlocks) {
  for_each_contour([](const Sample& tested) {
    Feeding feeding;
    feeding.watch = [](std::size_t ordinal, const std::vector<CompensatedBlock>& out) {
      if (ordinal < 2) return;
      std::set<std::int64_t> gone;
      for (const CompensatedBlock& block : out) gone.insert(block.source.number);
      EXPECT_LE(ordinal + 1, gone.size() + 2) << "after block " << ordinal;
    };
    const Outcome outcome = compensate(tested.contour, tested.mode, feeding);
    EXPECT_EQ(outcome.stopped, outcome.error() != nullptr);
  });
}

TEST_P(EveryContour, LosesNoTextAndKeepsItAfterItsBlock) {
  for_each_contour([](const Sample& tested) {
    const Feeding feeding = full_feeding();
    const Outcome outcome = compensate(tested.contour, tested.mode, feeding);
    if (outcome.stopped) return;
    std::vector<std::string> expected;
    for (std::size_t ordinal = 0; ordinal < tested.contour.blocks.size() + 2; ++ordinal)
      for (const std::string& text : feeding.texts(ordinal)) expected.push_back(text);
    std::vector<std::string> actual;
    std::int64_t host = -1;
    bool behind_inserted = false;
    for (const CompensatedBlock& block : outcome.blocks) {
      if (block.origin == Origin::passthrough) {
        actual.push_back(block.text);
        EXPECT_EQ(block.source.number, host) << block.text;
        EXPECT_FALSE(behind_inserted) << block.text << " (D-25)";
        continue;
      }
      behind_inserted = block.source.number == host;
      host = block.source.number;
    }
    EXPECT_EQ(actual, expected);
  });
}

// D-26: the trimmed block carries all travel of the other axes.
TEST_P(EveryContour, MovesOtherAxesOnlyWithTheProgrammedBlocks) {
  for_each_contour([](const Sample& tested) {
    const Feeding feeding = full_feeding();
    const Outcome outcome = compensate(tested.contour, tested.mode, feeding);
    std::int64_t host = -1;
    for (const CompensatedBlock& block : outcome.blocks) {
      if (block.origin == Origin::passthrough) continue;
      const auto ordinal = static_cast<std::size_t>(block.source.number);
      ASSERT_EQ(block.tracking.size(), 6U);
      if (block.source.number == host) {
        EXPECT_FALSE(block.normal.moves()) << text_of(block);
        EXPECT_FALSE(block.tracking[0].moves()) << text_of(block);
        continue;
      }
      host = block.source.number;
      EXPECT_EQ(block.normal.to, feeding.third(ordinal)) << text_of(block);
      EXPECT_EQ(block.tracking[0].to, feeding.tracking(ordinal)) << text_of(block);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Random, EveryContour, ::testing::ValuesIn(all_flavors),
                         [](const auto& tested) { return name_of(tested.param); });

// Turning away from the tool all the way, a contour can nowhere be gouged.
TEST(ConvexContour, IsNeverGouged) {
  for (std::uint64_t seed = 1; seed <= contours_per_flavor() / 10 && !::testing::Test::HasFailure();
       ++seed) {
    const Sample tested = sample(seed, Flavor::convex);
    SCOPED_TRACE(story(seed, tested));
    const Outcome outcome = compensate(tested.contour, tested.mode);
    ASSERT_FALSE(outcome.stopped);
    std::vector<Segment> path;
    for (const CompensatedBlock& block : moving(outcome.blocks))
      if (is_programmed(block) || is_inserted(block)) path.push_back(block.path);
    const double radius = tested.mode.tool_radius;
    const SlowClearance clearance = slow_clearance(path, tested.contour.blocks, radius / 8);
    EXPECT_NEAR(clearance.distance, radius, 1e-8 * size_of(tested.contour))
        << "in " << clearance.where.transpose();
  }
}

}  // namespace
}  // namespace trc::support
