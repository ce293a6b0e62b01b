#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "core/trc/corner/bow_tie.h"
#include "core/verify/clearance.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_shapes.h"
#include "tests/support/small_contours.h"

// Loop removal together with what else changes the contour or what is seen of it, on the small
// contours that are as hard as they get. Each has a seed of its own, which a failure prints and
// TRC_TEST_SEED takes alone; TRC_TEST_LONG=1 takes a hundred times as many.

namespace trc::support {
namespace {

double tolerance_of(double radius) { return 1.001e-6 * std::max(radius, 1.0); }  // rule 5.1

// What counts as rounded input may be cut by this much, mm (D-44): a short block that others tie,
// the seam of a closed contour, whose point cannot move, and anything beside a tool so small that
// all of its size is what counts as rounding.
double rounded_away(const SmallContour& made) {
  const double largest = largest_bow_tie(Tolerances{}.input_resolution, made.mode.tool_radius);
  const auto& blocks = made.contour.blocks;
  const bool is_closed = start_of(blocks.front()) == end_of(blocks.back());
  const bool has_short = std::any_of(blocks.begin(), blocks.end(), [&](const Segment& block) {
    return length_of(block) > 0 && length_of(block) <= longest_in_bow_tie(largest);
  });
  const bool is_tiny = made.mode.tool_radius < 0.01;
  return is_closed || has_short || is_tiny ? largest : 0;
}

bool is_between(const CompensatedBlock& block) {
  return block.origin != Origin::approach && block.origin != Origin::retract;
}

std::vector<Segment> path_of(const Outcome& outcome) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (is_between(block)) path.push_back(block.path);
  return path;
}

class HardContour : public ::testing::TestWithParam<Hardship> {
 protected:
  template <class Claim>
  static void for_each(std::uint64_t first_seed, std::uint64_t count, const Claim& claim) {
    if (is_long_run()) count *= 100;
    std::uint64_t first = first_seed + 1'000'000 * static_cast<std::uint64_t>(GetParam());
    if (const char* alone = std::getenv("TRC_TEST_SEED")) {
      first = std::stoull(alone);
      count = 1;
    }
    for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
      Random random(seed);
      SmallContour made = small_contour(random, GetParam());
      if (seed % 2 == 1) {
        made.mode.transition = Transition::linear;
        made.mode.options.stretch_factor = static_cast<double>(1 + seed / 2 % 9);
      }
      std::ostringstream story;
      story << "seed " << seed << ", " << text_of(made.mode) << '\n' << made.contour;
      SCOPED_TRACE(story.str());
      claim(made);
    }
  }
};

struct Changes {
  bool circles_to_lines = false;
  bool kerf_masking = false;
  bool circular_kerf_masking = true;
};

// What is converted and raised shows under SUPPRESS_TRC: from that contour the path keeps clear,
// and of the programmed one nothing else has changed.
TEST_P(HardContour, IsConvertedAndRaisedBeforeItsLoopsGo) {  // D-16, D-17, D-18
  std::size_t changed = 0;
  for (const Changes changes : {Changes{.circles_to_lines = true}, Changes{.kerf_masking = true},
                                Changes{.kerf_masking = true, .circular_kerf_masking = false},
                                Changes{.circles_to_lines = true, .kerf_masking = true}})
    for_each(70'000'000, 150, [&](SmallContour made) {
      made.mode.options.conv_cir_to_lin = changes.circles_to_lines;
      made.mode.options.kerf_masking = changes.kerf_masking;
      Feeding feeding;
      feeding.compensator.circular_kerf_masking = changes.circular_kerf_masking;
      const Outcome outcome = compensate(made.contour, made.mode, feeding);
      EXPECT_EQ(first_gap(outcome.blocks), "");
      made.mode.options.suppress_trc = true;
      const Outcome shown = compensate(made.contour, made.mode, feeding);
      ASSERT_FALSE(shown.stopped) << message_of(*shown.error());
      for (const CompensatedBlock& block : moving(shown.blocks)) {
        const bool as_programmed = block.origin == Origin::programmed;
        if (!as_programmed && is_between(block)) ++changed;
        const auto ordinal = static_cast<std::size_t>(block.source.number);
        if (!as_programmed) continue;
        const Segment& programmed = made.contour.blocks.at(ordinal - 1);
        EXPECT_EQ(is_arc(block.path), is_arc(programmed));
        EXPECT_EQ(start_of(block.path), start_of(programmed));
        EXPECT_EQ(end_of(block.path), end_of(programmed));
      }
      const auto path = path_of(outcome);
      if (outcome.stopped || path.empty()) return;
      const double radius = made.mode.tool_radius;
      EXPECT_GE(least_distance(path, path_of(shown)).distance,
                radius - tolerance_of(radius) - rounded_away(made))
          << text_of(outcome.blocks) << "beside\n"
          << text_of(shown.blocks);
    });
  EXPECT_GT(changed, 20U);
}

std::int64_t longest_loop(const Outcome& outcome) {
  std::int64_t longest = 0;
  std::int64_t last = 1;
  for (const CompensatedBlock& block : moving(outcome.blocks)) {
    longest = std::max(longest, block.source.number - last);
    last = block.source.number;
  }
  return longest;
}

Outcome seen_through(std::size_t window, const SmallContour& made) {
  Feeding feeding;
  feeding.compensator.limits.look_ahead_blocks = window;
  return compensate(made.contour, made.mode, feeding);
}

// Where equidistants lie on top of each other the path may change over elsewhere, or, once in some
// ten thousand contours, not at all.
TEST_P(HardContour, IsSeenWholeThroughAWindowLongerThanItsLoops) {  // D-10
  std::size_t compared = 0;
  std::size_t otherwise = 0;
  for_each(71'000'000, 600, [&](const SmallContour& made) {
    const Outcome whole = compensate(made.contour, made.mode);
    const Outcome wide = seen_through(made.contour.blocks.size() + 6, made);
    EXPECT_EQ(wide.stopped, whole.stopped);
    EXPECT_EQ(difference(wide.blocks, whole.blocks, Motion{}, 0), "");
    if (whole.stopped) return;
    // Of a loop that begins inside a mitre the length does not show.
    const std::int64_t more = made.mode.transition == Transition::linear ? 2 : 1;
    const Outcome seen =
        seen_through(static_cast<std::size_t>(more * (longest_loop(whole) + 1)), made);
    ++compared;
    if (seen.stopped || !difference(seen.blocks, whole.blocks, Motion{}, 1e-6).empty()) ++otherwise;
  });
  EXPECT_GT(compared, 100U);
  EXPECT_LE(1000 * otherwise, compared);
}

TEST_P(HardContour, IsKeptClearOfAsFarAsTheWindowReaches) {  // D-10
  std::size_t accepted = 0;
  for_each(72'000'000, 300, [&](const SmallContour& made) {
    for (const std::size_t window : {1U, 2U, 3U, 5U}) {
      const Outcome outcome = seen_through(window, made);
      EXPECT_EQ(first_gap(outcome.blocks), "") << "window " << window;
      if (outcome.stopped) continue;
      ++accepted;
      std::size_t last = 0;
      for (const CompensatedBlock& block : moving(outcome.blocks)) {
        const auto number = static_cast<std::size_t>(block.source.number);
        EXPECT_GE(number, last) << "out of order, window " << window;
        last = number;
        if (!is_between(block)) continue;
        // Lines of a mitre may lie beside the next block, whose window begins farther on.
        const bool is_of_mitre =
            block.origin == Origin::transition && std::holds_alternative<Line>(block.path);
        const std::size_t first = number + (is_of_mitre ? 1 : 0);
        std::vector<Segment> seen;
        for (std::size_t k = 1; k <= made.contour.blocks.size(); ++k)
          if (k + window >= first && k <= number + window)
            seen.push_back(made.contour.blocks[k - 1]);
        const double radius = made.mode.tool_radius;
        // The first and the last point cannot move.
        const bool is_at_end = number == 1 || number == made.contour.blocks.size();
        const double fixed = is_at_end ? Tolerances{}.on_contour : 0;
        EXPECT_GE(least_distance(std::vector<Segment>{block.path}, seen).distance,
                  radius - tolerance_of(radius) - std::max(fixed, rounded_away(made)))
            << "window " << window << ": " << text_of(block);
      }
    }
  });
  EXPECT_GT(accepted, 100U);
}

// At the point of a refusal the tool is as near as its radius, or nearer, to the block it names as
// the other one. Seldom a block is in its own way by less than counts as near, and runs back.
TEST_P(HardContour, IsRefusedForABlockThatIsInTheWay) {
  std::size_t refused = 0;
  std::size_t alone = 0;
  for_each(73'000'000, 600, [&](const SmallContour& made) {
    const Outcome outcome = compensate(made.contour, made.mode);
    if (!outcome.stopped) return;
    ++refused;
    const Diagnostic& error = *outcome.error();
    ASSERT_TRUE(error.point.has_value());
    const auto other = std::find_if(error.values.begin(), error.values.end(),
                                    [](const auto& value) { return value.name == "other_index"; });
    if (other == error.values.end()) {
      ++alone;
      return;
    }
    const auto ordinal = static_cast<std::size_t>(other->value);
    ASSERT_GE(ordinal, 1U);
    ASSERT_LE(ordinal, made.contour.blocks.size());
    const double radius = made.mode.tool_radius;
    const Point place(error.point->x, error.point->y);
    const Shape block = shape_of(made.contour.blocks[ordinal - 1]);
    EXPECT_LE(block.distance_to({place.x(), place.y()}), radius + 1e-6 * std::max(radius, 1.0))
        << message_of(error);
  });
  EXPECT_LE(50 * alone, refused);
  EXPECT_TRUE(refused > 50 || GetParam() == Hardship::slots) << refused;
}

// trc verify against the slow search.
TEST_P(HardContour, IsVerifiedAsTheSlowSearchMeasures) {
  std::size_t measured = 0;
  for_each(74'000'000, 300, [&](SmallContour made) {
    // Gouges are wanted as well.
    made.mode.masking = Masking::off;
    made.mode.options.remove_masked_blocks = false;
    made.mode.options.ignore_cont_damage = true;
    const Outcome outcome = compensate(made.contour, made.mode);
    if (outcome.stopped) return;
    const auto path = path_of(outcome);
    if (path.empty()) return;
    TrcMode mode = made.mode;
    mode.selection_number = 1;
    const auto shared = std::make_shared<const TrcMode>(mode);
    std::vector<Block> programmed{MotionBlock{
        .source = {.index = 0, .number = 0}, .path = made.contour.approach, .mode = shared}};
    for (const Segment& block : made.contour.blocks) {
      const std::size_t ordinal = programmed.size();
      programmed.emplace_back(
          MotionBlock{.source = {.index = ordinal, .number = static_cast<std::int64_t>(ordinal)},
                      .path = block,
                      .mode = shared});
    }
    const auto report =
        verify::measure_clearance(programmed, outcome.blocks, 1e-4, all_walls().leads);
    ASSERT_TRUE(report.worst.has_value());
    const double expected = least_distance(path, made.contour.blocks).distance;
    const double size = 1 + made.contour.approach.start.norm() + made.mode.tool_radius;
    const double tolerance = 1e-7 * size + verify::margin_resolution;
    // On the wrong side it says how far.
    if (report.worst->distance < 0) {
      EXPECT_LE(expected, -report.worst->distance + tolerance);
    } else {
      EXPECT_NEAR(report.worst->distance, expected, tolerance);
    }
    ++measured;
  });
  EXPECT_GT(measured, 100U);
}

INSTANTIATE_TEST_SUITE_P(LoopRemoval, HardContour, ::testing::ValuesIn(all_hardships),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace trc::support
