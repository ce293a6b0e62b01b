#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// REMOVE_MASKED_BLOCKS over contours full of violations (spec 5.1): what comes out
// keeps its distance, judged by sampling, is connected and in order, and no
// technology word is lost.

namespace trc::support {
namespace {

std::uint64_t contours_a_flavor() { return std::getenv("TRC_TEST_LONG") != nullptr ? 20'000 : 300; }

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
    const double radius = mode.tool_radius;
    const auto path = compensated(outcome);
    if (path.empty()) return;
    const SlowClearance clearance = slow_clearance(path, contour.blocks, radius / 20);
    EXPECT_GE(clearance.distance, radius - 1e-6 * std::max(radius, 1.0))
        << "at " << clearance.where.transpose() << ", short by " << radius - clearance.distance
        << ", path block " << clearance.path_block << ", contour block " << clearance.contour_block
        << '\n'
        << text_of(outcome.blocks);
  });
  std::cout << accepted << " accepted, " << refused << " refused\n";
}

}  // namespace
}  // namespace trc::support
