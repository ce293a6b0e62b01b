#include "core/session/path_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/trc/result/listing.h"

namespace trc::testing {
namespace {

MoveRequest line_to(std::uint64_t index, double x, double y) {
  MoveRequest request{.source = {.index = index, .number = static_cast<std::int64_t>(index)}};
  request.end[0] = x;
  request.end[1] = y;
  return request;
}

std::string listed(const std::vector<CompensatedBlock>& blocks) {
  std::string lines;
  for (const CompensatedBlock& block : blocks) {
    append_listing(lines, block, {}, 0);
    lines += '\n';
  }
  return lines;
}

TEST(PathSession, BlocksComeOutWhenTheyAreCertain) {
  SessionSetup setup;
  setup.program.start = {1, 2, 3};
  setup.program.mode.tool_radius = 10;
  PathSession session(setup);
  Answers out;

  ASSERT_TRUE(session.program().move(line_to(0, 0, 0)));
  ASSERT_TRUE(session.advance(out));
  EXPECT_EQ(listed(out.take().blocks), "0 uncompensated line 1 2 3 -> 0 0 3\n");

  ASSERT_TRUE(session.program().select(Side::left, {.index = 1}));
  ASSERT_TRUE(session.program().move(line_to(2, 30, 0)));
  ASSERT_TRUE(session.advance(out));
  EXPECT_EQ(listed(out.take().blocks), "");

  ASSERT_TRUE(session.program().move(line_to(3, 60, 0)));
  ASSERT_TRUE(session.program().deselect({.index = 4}));
  ASSERT_TRUE(session.program().move(line_to(5, 90, 0)));
  ASSERT_TRUE(session.advance(out));
  ASSERT_TRUE(session.finish({.index = 6}, out));
  EXPECT_EQ(listed(out.take().blocks),
            "2 approach line 0 0 3 -> 30 10 3\n"
            "3 programmed line 30 10 3 -> 60 10 3\n"
            "5 retract line 60 10 3 -> 90 0 3\n");
  EXPECT_EQ(session.summary().blocks_in, 4U);
}

// D-37: in messages as in text. The path up to where the tool stands is certain.
TEST(PathSession, AnArcAfterADeselectionUnderG239IsRefusedWhereverItsCentreIs) {
  for (const Point& center : {Point(0, -50), Point(0, -10), Point(20, 0)}) {
    SessionSetup setup;
    setup.program.mode.tool_radius = 10;
    setup.program.mode.selection = Selection::without_block;
    PathSession session(setup);
    Answers answers;
    ProgramState& program = session.program();
    ASSERT_TRUE(program.select(Side::left, {.index = 0}));
    ASSERT_TRUE(program.move(line_to(1, 30, 20)));
    ASSERT_TRUE(program.move(line_to(2, 60, 20)));
    ASSERT_TRUE(program.deselect({.index = 3}));
    MoveRequest arc = line_to(4, 90, 20);
    arc.kind = MotionKind::clockwise;
    arc.center = {center.x(), center.y(), std::nullopt};
    EXPECT_FALSE(program.move(arc));
    EXPECT_FALSE(session.advance(answers));
    const Answer out = answers.take();
    EXPECT_EQ(listed(out.blocks),
              "1 approach line 0 0 0 -> 30 30 0\n"
              "2 programmed line 30 30 0 -> 60 30 0\n");
    const std::vector<Diagnostic>& reported = out.diagnostics;
    ASSERT_EQ(reported.size(), 1U);
    EXPECT_EQ(reported[0].code, Code::circle_center_misfit);
    ASSERT_TRUE(reported[0].point);
    EXPECT_EQ(reported[0].point->x, 60);
    EXPECT_EQ(reported[0].point->y, 30);
  }
}

// A long staircase whose end sets free some thousand blocks at once, in the motion after it or at
// the end of the program.
bool compensate_staircase(SessionSetup setup, bool deselected, Answers& out) {
  constexpr std::uint64_t steps = 3000;
  setup.program.mode.tool_radius = 0.3;
  setup.program.mode.masking = Masking::on;
  setup.program.mode.options.remove_masked_blocks = true;
  PathSession session(setup);
  ProgramState& program = session.program();
  std::uint64_t index = 0;
  bool going = program.select(Side::left, {.index = index++});
  for (std::uint64_t step = 0; step < steps && going; ++step) {
    const auto at = static_cast<double>(step);
    going = program.move(line_to(index++, at + 1, at)) &&
            program.move(line_to(index++, at + 1, at + 1)) && session.advance(out);
  }
  if (deselected)
    going = going && program.deselect({.index = index++}) &&
            program.move(line_to(index++, 0, 2.0 * steps)) && session.advance(out);
  return going && session.finish({.index = index}, out);
}

TEST(PathSession, TheEndOfALongSelectionLeavesInPortions) {
  for (const Verify verify : {Verify::off, Verify::enforce})
    for (const bool deselected : {false, true}) {
      const SessionSetup setup{.verify = verify};
      Answers kept;
      ASSERT_TRUE(compensate_staircase(setup, deselected, kept));
      const std::vector<CompensatedBlock> whole = kept.take().blocks;
      ASSERT_GT(whole.size(), 5000U);

      std::vector<CompensatedBlock> taken;
      std::size_t largest = 0;
      Answers handed_on([&](const Answer& part) {
        largest = std::max(largest, part.blocks.size());
        taken.insert(taken.end(), part.blocks.begin(), part.blocks.end());
        return true;
      });
      ASSERT_TRUE(compensate_staircase(setup, deselected, handed_on));
      EXPECT_LT(largest, 1200U);
      EXPECT_EQ(listed(taken), listed(whole)) << "verify " << static_cast<int>(verify);
    }
}

TEST(PathSession, StopsWhereNoMoreIsWanted) {
  std::size_t parts = 0;
  Answers out([&](const Answer& /*part*/) { return ++parts < 3; });
  EXPECT_FALSE(compensate_staircase({}, true, out));
  EXPECT_EQ(parts, 3U);
}

TEST(PathSession, NothingComesOutAfterAnError) {
  SessionSetup setup;
  setup.program.mode.tool_radius = 10;
  PathSession session(setup);
  Answers out;
  ASSERT_TRUE(session.program().move(line_to(0, 5, 0)));
  EXPECT_FALSE(session.program().move(line_to(1, 2e6, 0)));
  EXPECT_FALSE(session.advance(out));
  EXPECT_FALSE(session.finish({.index = 2}, out));
  const Answer whole = out.take();
  EXPECT_EQ(whole.blocks.size(), 1U);  // what was given before it, as if given alone
  ASSERT_EQ(whole.diagnostics.size(), 1U);
  EXPECT_EQ(whole.diagnostics[0].code, Code::end_point_out_of_range);
}

// Each diagnostic with the number of blocks before it.
std::vector<std::string> order_of(const Answers& answers) {
  std::vector<std::string> order;
  std::size_t blocks = 0;
  for (const Answer& part : answers.parts()) {
    blocks += part.blocks.size();
    for (const Diagnostic& told : part.diagnostics)
      order.push_back(std::to_string(static_cast<int>(told.code)) + " of " +
                      std::to_string(told.source.index) + " after " + std::to_string(blocks));
  }
  order.push_back(std::to_string(blocks));
  return order;
}

// Blocks on both sides of a message of the reader, and one of the compensation before it.
TEST(PathSession, DiagnosticsHaveTheSamePlacesHoweverMuchIsGivenAtOnce) {
  SessionSetup setup;
  setup.program.mode.tool_radius = 10;
  const auto order_with = [&](std::uint64_t group) {
    PathSession session(setup);
    ProgramState& program = session.program();
    Answers out;
    for (std::uint64_t index = 0; index < 40; ++index) {
      const auto x = static_cast<double>(10 * index);
      // A selection that has no contour, and a feed nobody can drive.
      if (index == 7) program.select(Side::left, {.index = index});
      if (index == 8) program.select(Side::off, {.index = index});
      MoveRequest move = line_to(index, x, index % 2 == 0 ? 0 : 5);
      if (index == 30) move.feed = -1;
      const bool goes_on = program.move(move);
      if (!goes_on || (index + 1) % group == 0) session.advance(out);
      if (!goes_on) break;
    }
    return order_of(out);
  };
  const std::vector<std::string> alone = order_with(1);
  ASSERT_EQ(alone.size(), 3U);
  EXPECT_NE(alone[1].find("of 30 after 3"), std::string::npos) << alone[1];
  for (const std::uint64_t group : {2U, 5U, 9U, 16U, 40U})
    EXPECT_EQ(order_with(group), alone) << group;
}

}  // namespace
}  // namespace trc::testing
