// What blocks that TRC inserts carry besides their geometry.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/session/path_session.h"
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
  Answers answers;
  const auto move = [&](std::optional<double> x, std::optional<double> y, std::optional<double> z) {
    MoveRequest request;
    request.end = {x, y, z};
    EXPECT_TRUE(session.program().move(request) && session.advance(answers));
  };
  EXPECT_TRUE(session.program().select(Side::left, {}));
  move(10, 0, std::nullopt);
  move(50, std::nullopt, std::nullopt);
  move(std::nullopt, std::nullopt, third);
  move(std::nullopt, -50, std::nullopt);
  EXPECT_TRUE(session.program().deselect({}));
  move(20, std::nullopt, std::nullopt);
  EXPECT_TRUE(session.finish({}, answers));
  return answers.take().blocks;
}

// D-25, D-26: the plunge comes before the arc, and the arc runs at its depth.
TEST(InsertedBlocks, StandWhereThePassiveBlockHasMovedTheThirdAxis) {
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

// G141, R = 5, G42: a notch of 1 mm in a wall whose second part is half a micrometre out of line.
// Both blocks of the notch are masked, but plunge; the line that leads over runs at their depth.
TEST(InsertedBlocks, StandWhereMaskedBlocksHaveMovedTheThirdAxis) {
  SessionSetup setup;
  setup.program.mode.tool_radius = 5;
  setup.program.mode.masking = Masking::on;
  PathSession session(setup);
  Answers out;
  const auto move = [&](double x, double y, std::optional<double> z = {}) {
    MoveRequest request;
    request.end = {x, y, z};
    EXPECT_TRUE(session.program().move(request) && session.advance(out));
  };
  EXPECT_TRUE(session.program().select(Side::right, {}));
  move(10, 0);
  move(20, 0);
  move(21, 3, -1);
  move(22, 0.0005, -2);
  move(60, 0.0005);
  EXPECT_TRUE(session.program().deselect({}));
  move(80, 0);
  EXPECT_TRUE(session.finish({}, out));
  const std::vector<CompensatedBlock> blocks = out.take().blocks;
  EXPECT_EQ(support::first_gap(blocks), "");
  const auto masked = std::ranges::count(blocks, Origin::masked, &CompensatedBlock::origin);
  EXPECT_EQ(masked, 2);
  const auto across = std::ranges::find(blocks, Origin::transition, &CompensatedBlock::origin);
  ASSERT_NE(across, blocks.end());
  EXPECT_EQ(across->normal.from, -2);
  EXPECT_EQ(across->normal.to, -2);
  EXPECT_EQ(std::get<Line>(across->path).start, Point(20, -5));
  EXPECT_EQ(std::get<Line>(across->path).end.y(), 0.0005 - 5);
}

}  // namespace
}  // namespace trc
