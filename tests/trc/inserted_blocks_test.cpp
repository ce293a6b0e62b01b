// What blocks that TRC inserts carry besides their geometry.

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/session/session.h"
#include "tests/support/run.h"

namespace trc {
namespace {

// G26, R = 5, G41: an outside corner of 90 degrees at (50, 0), with a motion of
// the third axis alone between its two blocks.
std::vector<CompensatedBlock> corner_with_plunge(double third) {
  SessionSetup setup;
  setup.program.mode.tool_radius = 5;
  setup.program.mode.transition = Transition::circular;
  PathSession session(setup);
  std::vector<CompensatedBlock> blocks;
  const auto move = [&](std::optional<double> x, std::optional<double> y, std::optional<double> z) {
    MoveRequest request;
    request.end = {x, y, z};
    EXPECT_TRUE(session.program().move(request) && session.advance(blocks));
  };
  EXPECT_TRUE(session.program().select(Side::left, {}));
  move(10, 0, std::nullopt);
  move(50, std::nullopt, std::nullopt);
  move(std::nullopt, std::nullopt, third);
  move(std::nullopt, -50, std::nullopt);
  EXPECT_TRUE(session.program().deselect({}));
  move(20, std::nullopt, std::nullopt);
  EXPECT_TRUE(session.finish({}, blocks));
  return blocks;
}

// D-25, D-26: the plunge comes before the arc, and the arc runs at its depth.
TEST(InsertedBlocks, StandWhereTheRiderHasMovedTheThirdAxis) {
  const std::vector<CompensatedBlock> blocks = corner_with_plunge(-3);
  EXPECT_EQ(support::first_gap(blocks), "");
  bool plunged = false;
  std::size_t arcs = 0;
  for (const CompensatedBlock& block : blocks) {
    plunged = plunged || block.normal.to == -3;
    if (block.origin != Origin::transition) continue;
    ++arcs;
    EXPECT_TRUE(plunged);
    EXPECT_EQ(block.normal.from, -3);
    EXPECT_EQ(block.normal.to, -3);
  }
  EXPECT_EQ(arcs, 1U);
}

}  // namespace
}  // namespace trc
