#include <gtest/gtest.h>

#include "core/session/session.h"
#include "core/trc/listing.h"

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
  std::vector<CompensatedBlock> out;

  ASSERT_TRUE(session.program().move(line_to(0, 0, 0)));
  ASSERT_TRUE(session.advance(out));
  EXPECT_EQ(listed(out), "0 uncompensated line 1 2 3 -> 0 0 3\n");
  out.clear();

  ASSERT_TRUE(session.program().select(Side::left, {.index = 1}));
  ASSERT_TRUE(session.program().move(line_to(2, 30, 0)));
  ASSERT_TRUE(session.advance(out));
  EXPECT_EQ(listed(out), "");

  ASSERT_TRUE(session.program().move(line_to(3, 60, 0)));
  ASSERT_TRUE(session.program().deselect({.index = 4}));
  ASSERT_TRUE(session.program().move(line_to(5, 90, 0)));
  ASSERT_TRUE(session.advance(out));
  ASSERT_TRUE(session.finish({.index = 6}, out));
  EXPECT_EQ(listed(out),
            "2 approach line 0 0 3 -> 30 10 3\n"
            "3 programmed line 30 10 3 -> 60 10 3\n"
            "5 retract line 60 10 3 -> 90 0 3\n");
  EXPECT_EQ(session.summary().blocks_in, 4U);
}

TEST(PathSession, NothingComesOutAfterAnError) {
  SessionSetup setup;
  setup.program.mode.tool_radius = 10;
  PathSession session(setup);
  std::vector<CompensatedBlock> out;
  ASSERT_TRUE(session.program().move(line_to(0, 5, 0)));
  EXPECT_FALSE(session.program().move(line_to(1, 2e6, 0)));
  EXPECT_FALSE(session.advance(out));
  EXPECT_FALSE(session.finish({.index = 2}, out));
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(session.diagnostics().take().at(0).code, Code::end_point_out_of_range);
}

}  // namespace
}  // namespace trc::testing
