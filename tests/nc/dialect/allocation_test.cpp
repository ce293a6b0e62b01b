// Counts what the reader takes from the heap: a program of its own, since it
// replaces the allocation functions.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/nc/dialect/interpreter.h"
#include "tests/support/allocations.h"

namespace trc {
namespace {

TEST(Reader, TakesNothingFromTheHeapForLinesLikeThoseBefore) {
  std::string text;
  for (int line = 0; line < 200; ++line) {
    const std::string number = std::to_string(line);
    text.append("N").append(number).append(" G01 X").append(number).append(".125 Y-3.5 F500\n");
    text.append("G02 X").append(number).append(".625 I0.25 (a comment)\r\n");
  }
  Diagnostics diagnostics;
  std::vector<Block> blocks;
  std::vector<LinePointer> lines;
  ProgramState state({}, {}, diagnostics, blocks);
  Interpreter interpreter({}, state, diagnostics);
  std::size_t taken = 0;
  for (int round = 0; round < 4; ++round) {
    const std::size_t before = support::allocations();
    ASSERT_TRUE(interpreter.feed(text, lines));
    EXPECT_EQ(blocks.size(), 400U);
    for (LinePointer& line : lines) interpreter.recycle(std::move(line));
    lines.clear();
    blocks.clear();
    taken = support::allocations() - before;
    if (round == 0) {
      EXPECT_GT(taken, 400U) << "the count works";
    }
  }
  EXPECT_EQ(taken, 0U);
}

}  // namespace
}  // namespace trc
