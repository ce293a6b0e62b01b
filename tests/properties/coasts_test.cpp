#include "tests/support/coasts.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "tests/support/drawn_rings.h"
#include "tests/support/long_run.h"

// Loop removal on the coasts of the world. In the long runs alone.

namespace trc::support {
namespace {

std::vector<std::string> resolutions() {
  if (!is_long_run()) return {};
  return {"c", "l", "i", "h"};
}

class Coasts : public testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Coasts);

TEST_P(Coasts, AreGoneRoundOutsideAndInside) {
  Geos geos;
  Tally tally;
  for (const auto& ring : coasts(GetParam())) {
    if (ring.size() < 20) continue;
    for (const double radius : {0.02, 0.3, 2.0})
      for (const Side side : {Side::left, Side::right})
        for (const Transition transition : {Transition::circular, Transition::linear}) {
          const TrcMode mode = mode_of_ring(radius, side, transition);
          SCOPED_TRACE(std::to_string(ring.size()) + " edges from " +
                       std::to_string(ring.front().x()) + ' ' + std::to_string(ring.front().y()) +
                       ", " + text_of(mode));
          const auto edges = begun_with_room(ring, mode);
          if (!edges.empty()) judge(geos, edges, mode, tally);
        }
  }
  EXPECT_GT(tally.compared, 100U);
  EXPECT_TRUE(tally.agrees());
  std::cout << tally.text() << '\n';
}

INSTANTIATE_TEST_SUITE_P(Resolution, Coasts, testing::ValuesIn(resolutions()),
                         [](const auto& resolution) { return resolution.param; });

}  // namespace
}  // namespace trc::support
