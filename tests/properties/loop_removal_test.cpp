#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// REMOVE_MASKED_BLOCKS over contours full of violations (rule 5.1): what comes out
// keeps its distance, judged by sampling, is connected and in order, and no
// technology word is lost.

namespace trc::support {
namespace {

std::uint64_t contours_a_flavor() { return is_long_run() ? 20'000 : 300; }

TrcMode removing_mode(Random& random) {
  TrcMode mode = random_mode(random);
  mode.masking = Masking::on;
  mode.options.remove_masked_blocks = true;
  return mode;
}

template <class Claim>
void for_each_contour(std::uint64_t first_seed, std::size_t longest, const Claim& claim) {
  for (const Flavor flavor : all_flavors)
    for (std::uint64_t k = 0; k < contours_a_flavor() && !::testing::Test::HasFailure(); ++k) {
      const std::uint64_t seed = first_seed + 100'000 * static_cast<std::uint64_t>(flavor) + k;
      Random random(seed);
      const TrcMode mode = removing_mode(random);
      const Contour contour = random_contour(random, flavor, mode, longest);
      std::ostringstream story;
      story << "seed " << seed << ", " << name_of(flavor) << ", " << text_of(mode) << '\n'
            << contour;
      SCOPED_TRACE(story.str());
      claim(contour, mode, flavor);
    }
}

std::vector<Segment> compensated(const Outcome& outcome) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  return path;
}

void expect_clear(const Outcome& outcome, const Contour& contour, const TrcMode& mode) {
  const double radius = mode.tool_radius;
  const auto path = compensated(outcome);
  if (path.empty()) return;
  const SlowClearance clearance = slow_clearance(path, contour.blocks, radius / 20);
  EXPECT_GE(clearance.distance, radius - 1e-6 * std::max(radius, 1.0))
      << "at " << clearance.where.transpose() << ", short by " << radius - clearance.distance
      << ", path block " << clearance.path_block << ", contour block " << clearance.contour_block
      << '\n'
      << text_of(outcome.blocks);
}

// G25, G42, R = 7, STRETCH_FACTOR = 6: a tip of three degrees, after it an arc of 247 degrees
// whose inside the tool just fits into. The mitre round the tip is 42 mm long; on its way back to
// the arc it passes the far end of it, so that the circle round the tip stays.
TEST(LoopRemoval, KeepsAMitreOffTheFarEndOfTheArcAfterIt) {  // D-45
  TrcMode mode;
  mode.side = Side::right;
  mode.tool_radius = 7;
  mode.transition = Transition::linear;
  mode.masking = Masking::on;
  mode.options.remove_masked_blocks = true;
  mode.options.stretch_factor = 6;
  const Point center(67.7014, 108.7107);
  const Point tip(59.1563, 107.1374);
  const double sweep = -4.3162;
  const Vector begins = tip - center;
  const Vector ends = {begins.x() * std::cos(sweep) - begins.y() * std::sin(sweep),
                       begins.x() * std::sin(sweep) + begins.y() * std::cos(sweep)};
  Contour contour;
  const Point begin(56.5383, 121.3569);
  contour.approach = {.start = {20, 100}, .end = begin};
  contour.blocks = {Line{.start = begin, .end = tip},
                    Arc{.start = tip, .end = center + ends, .center = center, .sweep = sweep}};
  contour.retract = {.start = center + ends, .end = {81, 117.5}};
  const Outcome outcome = compensate(contour, mode);
  ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
  EXPECT_EQ(std::ranges::count(outcome.blocks, Origin::transition, &CompensatedBlock::origin), 1);
  expect_clear(outcome, contour, mode);
}

TEST(LoopRemoval, NeverGouges) {
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for_each_contour(40'000'000, 16, [&](const Contour& contour, const TrcMode& mode, Flavor) {
    const Outcome outcome = compensate(contour, mode);
    EXPECT_EQ(first_gap(outcome.blocks), "");
    if (outcome.stopped) {
      ++refused;
      return;
    }
    ++accepted;
    expect_clear(outcome, contour, mode);
  });
  std::cout << accepted << " accepted, " << refused << " refused\n";
}

// The longest loop, in contour blocks, that was taken out.
std::int64_t longest_loop(const Outcome& outcome) {
  std::int64_t longest = 0;
  std::int64_t last = 1;
  for (const CompensatedBlock& block : outcome.blocks) {
    longest = std::max(longest, block.source.number - last);
    last = block.source.number;
  }
  return longest;
}

// Expects each block to be clear of the contour that its window shows, `window` blocks to both
// sides.
void expect_clear_in_window(const Outcome& outcome, const Contour& contour, const TrcMode& mode,
                            std::int64_t window) {
  const double radius = mode.tool_radius;
  const auto count = static_cast<std::int64_t>(contour.blocks.size());
  for (const CompensatedBlock& block : moving(outcome.blocks)) {
    if (block.origin != Origin::programmed && block.origin != Origin::transition) continue;
    const std::int64_t first = std::max<std::int64_t>(block.source.number - window, 1);
    const std::int64_t end = std::min(block.source.number + window, count) + 1;
    const std::span<const Segment> shown =
        std::span(contour.blocks)
            .subspan(static_cast<std::size_t>(first - 1), static_cast<std::size_t>(end - first));
    const SlowClearance clearance = slow_clearance(std::span(&block.path, 1), shown, radius / 20);
    EXPECT_GE(clearance.distance, radius - 1e-6 * std::max(radius, 1.0))
        << "at " << clearance.where.transpose() << ", block " << block.source.number
        << ", contour block " << first + static_cast<std::int64_t>(clearance.contour_block) << '\n'
        << text_of(outcome.blocks);
  }
}

TEST(LoopRemoval, SeesInAWindowWhatTheWholeContourShows) {  // D-10
  std::size_t compared = 0;
  std::size_t another_way = 0;
  for_each_contour(41'000'000, 30, [&](const Contour& contour, const TrcMode& mode, Flavor) {
    const Outcome whole = compensate(contour, mode);
    if (whole.stopped) return;
    const std::int64_t loop = longest_loop(whole);
    // Where a mitre is crossed, loops that begin inside it have a say as well; how long those are
    // cannot be seen in the path. Seldom the window then finds another way, clear of all that it
    // shows, as it may where two equidistants lie on top of each other, or where what is in the way
    // of a mitre is farther on; or none, where it had to go back to a pass that has left.
    const bool mitres = mode.transition == Transition::linear;
    for (const std::int64_t window : {mitres ? 2 * loop + 2 : loop + 1, loop + 20}) {
      CompensatorSetup setup = all_walls();
      setup.limits.look_ahead_blocks = static_cast<std::size_t>(window);
      const Outcome seen = compensate(contour, mode, {.compensator = setup});
      EXPECT_EQ(first_gap(seen.blocks), "");
      const std::string differs = difference(seen.blocks, whole.blocks, Motion{}, 1e-9);
      ++compared;
      if (!seen.stopped && differs.empty()) continue;
      expect_clear_in_window(seen, contour, mode, window);
      ++another_way;
    }
  });
  EXPECT_GT(compared, contours_a_flavor());
  EXPECT_LE(1000 * another_way, compared);
}

// A corner needs three blocks more than the window: the one after it to be known as
// relevant, the one after a notch, the one a transition leads to.
constexpr std::int64_t blocks_of_a_corner = 4;

TEST(LoopRemoval, LetsABlockGoWhenItsWindowHasCome) {  // D-10
  std::size_t compared = 0;
  for_each_contour(42'000'000, 60, [&](const Contour& contour, const TrcMode& mode, Flavor) {
    for (const bool removing : {true, false}) {
      TrcMode masking = mode;
      masking.options.remove_masked_blocks = removing;
      CompensatorSetup setup = all_walls();
      setup.limits.look_ahead_blocks = 5;
      // How far the path had come, and should have come, after each block.
      std::vector<std::pair<std::int64_t, std::int64_t>> progress;
      const auto watch = [&](std::size_t ordinal, const std::vector<CompensatedBlock>& out) {
        if (ordinal > contour.blocks.size()) return;
        std::int64_t reached = 0;
        for (const CompensatedBlock& block : out) reached = std::max(reached, block.source.number);
        progress.emplace_back(reached, static_cast<std::int64_t>(ordinal) - 5 - blocks_of_a_corner);
      };
      const Outcome outcome = compensate(contour, masking, {.compensator = setup, .watch = watch});
      if (outcome.stopped) continue;
      for (const auto& [reached, due] : progress)
        for (std::size_t at = 0; at + 1 < outcome.blocks.size(); ++at) {
          const CompensatedBlock& block = outcome.blocks[at];
          // Without a window of its own a block leaves with the one it is joined to.
          if (outcome.blocks[at + 1].origin == Origin::masked) continue;
          EXPECT_FALSE(block.source.number > reached && block.source.number <= due)
              << (removing ? "removing, " : "masking, ") << "only " << reached << " of " << due
              << " had left: " << text_of(block);
        }
      compared += progress.size();
    }
  });
  EXPECT_GT(compared, contours_a_flavor());
}

}  // namespace
}  // namespace trc::support
