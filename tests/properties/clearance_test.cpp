#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// What is found far away along a contour: bottlenecks under G140 and G141,
// judged by sampling the path against every block of the contour.

namespace trc::support {
namespace {

constexpr std::uint64_t contours = 150;

struct Sample {
  TrcMode mode{};
  Contour contour{};
  // Clearance of the path that G140 gives, less the radius, mm.
  double spare = 0;
};

double spare_of(const Outcome& outcome, const Contour& contour, double radius) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  if (path.empty()) return std::numeric_limits<double>::infinity();
  return slow_clearance(path, contour.blocks, radius / 10).distance - radius;
}

// Contours without a violation between neighbours, and a clear answer to the
// question whether they have one farther away.
template <class Claim>
void for_each_sample(std::uint64_t first_seed, const Claim& claim) {
  for (const Flavor flavor : {Flavor::mixed, Flavor::lines, Flavor::short_blocks})
    for (std::uint64_t k = 0; k < contours && !::testing::Test::HasFailure(); ++k) {
      const std::uint64_t seed = first_seed + 10'000 * static_cast<std::uint64_t>(flavor) + k;
      Random random(seed);
      Sample tested;
      tested.mode = random_mode(random);
      tested.contour = random_clean_contour(random, flavor, tested.mode, 12);
      const Outcome plain = compensate(tested.contour, tested.mode);
      ASSERT_FALSE(plain.stopped);
      tested.spare = spare_of(plain, tested.contour, tested.mode.tool_radius);
      if (tested.spare < -1e-7 && tested.spare > -1e-3) continue;
      std::ostringstream story;
      story << "seed " << seed << ", " << name_of(flavor) << ", " << text_of(tested.mode)
            << ", spare clearance " << tested.spare << '\n'
            << tested.contour;
      SCOPED_TRACE(story.str());
      claim(tested, plain);
    }
}

TEST(ImplicitMasking, StopsExactlyWhereSamplingFindsAGouge) {  // D-34
  std::size_t gouged = 0;
  std::size_t clear = 0;
  for_each_sample(1'000'000, [&](const Sample& tested, const Outcome& plain) {
    Feeding feeding;
    feeding.compensator.implicit_contour_masking = true;
    const Outcome outcome = compensate(tested.contour, tested.mode, feeding);
    if (tested.spare >= -1e-7) {
      ++clear;
      ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
      EXPECT_EQ(difference(outcome.blocks, plain.blocks, Motion{}, 0), "");
      return;
    }
    ++gouged;
    ASSERT_TRUE(outcome.stopped);
    EXPECT_EQ(outcome.error()->code, Code::bottleneck) << message_of(*outcome.error());
  });
  EXPECT_GT(gouged, contours / 10);
  EXPECT_GT(clear, contours / 2);
}

TEST(ContourMasking, LeavesWhatIsNotViolatedAndWarnsOfBottlenecks) {
  for_each_sample(2'000'000, [](const Sample& tested, const Outcome& plain) {
    TrcMode mode = tested.mode;
    mode.masking = Masking::on;
    const Outcome outcome = compensate(tested.contour, mode);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_EQ(difference(outcome.blocks, plain.blocks, Motion{}, 1e-9), "");
    EXPECT_EQ(outcome.diagnostics.empty(), tested.spare >= -1e-7);
  });
}

// G141 over contours full of violations: whatever comes out is connected, in
// order, and no text is lost.
TEST(ContourMasking, LosesNothingAndStaysConnected) {
  std::size_t masked = 0;
  for (const Flavor flavor : all_flavors)
    for (std::uint64_t k = 0; k < contours && !::testing::Test::HasFailure(); ++k) {
      const std::uint64_t seed = 3'000'000 + 10'000 * static_cast<std::uint64_t>(flavor) + k;
      Random random(seed);
      TrcMode mode = random_mode(random);
      mode.masking = Masking::on;
      const Contour contour = random_contour(random, flavor, mode, 12);
      std::ostringstream story;
      story << "seed " << seed << ", " << name_of(flavor) << ", " << text_of(mode) << '\n'
            << contour;
      SCOPED_TRACE(story.str());
      const Outcome outcome =
          compensate(contour, mode, {.texts = [](std::size_t ordinal) {
                       return std::vector<std::string>{"M" + std::to_string(ordinal)};
                     }});
      EXPECT_EQ(first_gap(outcome.blocks), "");
      if (outcome.stopped) {
        EXPECT_TRUE(outcome.error()->point.has_value()) << message_of(*outcome.error());
        continue;
      }
      std::int64_t number = 0;
      std::vector<std::string> texts;
      for (const CompensatedBlock& block : outcome.blocks) {
        EXPECT_GE(block.source.number, number) << text_of(block);
        number = block.source.number;
        if (block.origin == Origin::passthrough) texts.push_back(block.text);
        if (block.origin == Origin::masked) ++masked;
      }
      ASSERT_EQ(texts.size(), contour.blocks.size() + 2) << text_of(outcome.blocks);
      for (std::size_t ordinal = 0; ordinal < texts.size(); ++ordinal)
        EXPECT_EQ(texts[ordinal], "M" + std::to_string(ordinal));
    }
  EXPECT_GT(masked, contours / 10);
}

}  // namespace
}  // namespace trc::support
