#include "core/nc/program/program_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/nc/program/fanuc_programs.h"
#include "core/nc/program/program_text.h"

// A text of a program that computes is executed, and read to its end, in steps: between them others
// have their turn, and what a step takes is accounted for.

namespace trc {
namespace {

using program::ProgramText;

std::string repeated(std::size_t count, const std::string& line) {
  std::string text;
  text.reserve(count * line.size());
  for (std::size_t i = 0; i < count; ++i) text += line;
  return text;
}

// What comes out of a text, and the steps it takes.
struct Steps {
  std::size_t lines = 0;
  std::size_t most_lines = 0;  // of one step after the last text
  std::size_t interrupts = 0;
  bool refused = false;
};

Steps steps_of(const std::string& text, DialectName dialect) {
  Steps steps;
  ProgramSetup setup;
  setup.dialect = dialect;
  Diagnostics diagnostics;
  std::vector<Block> blocks;
  ProgramState state(setup, {}, diagnostics, blocks);
  ProgramReader reader({}, state, diagnostics, [&] { ++steps.interrupts; });
  std::vector<LinePointer> lines;
  const auto take = [&] {
    steps.lines += lines.size();
    lines.clear();
  };
  reader.feed(text, lines);
  take();
  bool is_left = true;
  while (is_left) {
    is_left = reader.resolve(lines);
    steps.most_lines = std::max(steps.most_lines, lines.size());
    take();
  }
  reader.finish(lines);
  steps.most_lines = std::max(steps.most_lines, lines.size());
  take();
  steps.refused = diagnostics.stopped();
  return steps;
}

constexpr std::size_t few_lines = 300;
constexpr std::size_t many_lines = 20'000;

TEST(ProgramReader, ReadsTheTextAfterTheEndInSteps) {
  for (const auto& [dialect, begin] : {std::pair(DialectName::fanuc, "O1\n#1=0\nG0 X#1\nM30\n"),
                                       std::pair(DialectName::linuxcnc, "#1=0\nG0 X#1\nM2\n"),
                                       std::pair(DialectName::sinumerik, "R1=0\nG0 X=R1\nM30\n"),
                                       std::pair(DialectName::isg, "P1=0\nG0 XP1\nM30\n")}) {
    const Steps steps = steps_of(begin + repeated(many_lines, "\n"), dialect);
    EXPECT_FALSE(steps.refused) << begin;
    EXPECT_GE(steps.lines, many_lines) << begin;
    EXPECT_LE(steps.most_lines, few_lines) << begin;
  }
}

// It was collected because of M99 before it, but nothing in it computes.
TEST(ProgramReader, ReadsACollectedTextThatDoesNotComputeInSteps) {
  const Steps steps = steps_of("O1\nM99\n" + repeated(many_lines, "G0 X1\n"), DialectName::fanuc);
  EXPECT_FALSE(steps.refused);
  EXPECT_GE(steps.lines, many_lines);
  EXPECT_LE(steps.most_lines, 10 * few_lines);
}

// A line is executed in one step.
TEST(ProgramReader, RefusesALineThatIsTooLongToBeExecuted) {
  ProgramSetup setup;
  setup.dialect = DialectName::fanuc;
  Diagnostics diagnostics;
  std::vector<Block> blocks;
  ProgramState state(setup, {}, diagnostics, blocks);
  ProgramReader reader({.longest_line = 100}, state, diagnostics);
  std::vector<LinePointer> lines;
  EXPECT_TRUE(reader.feed("#1=0\nG0\n" + std::string(80, ' ') + "\n(", lines));
  EXPECT_TRUE(reader.feed(std::string(99, 'A'), lines));
  EXPECT_FALSE(reader.feed("A", lines));
  ASSERT_EQ(diagnostics.pending().size(), 1U);
  EXPECT_EQ(diagnostics.pending()[0].code, Code::nc_line_too_long);
  EXPECT_EQ(diagnostics.pending()[0].source.line, 4U);
}

TEST(ProgramText, PassesForEachLine) {
  std::size_t interrupts = 0;
  Checkpoint checkpoint([&] { ++interrupts; });
  const ProgramText text({}, repeated(many_lines, "\n"), 1, &checkpoint);
  EXPECT_EQ(text.size(), many_lines);
  EXPECT_GE(interrupts, many_lines / 256);
  interrupts = 0;
  static_cast<void>(program::main_program_of(text, {}, checkpoint));
  EXPECT_GE(interrupts, many_lines / 256);
}

TEST(ProgramText, HasItsLinesAndTheirEnds) {
  const ProgramText text({}, "A\r\nB\r\rC\n\r\n\nD");
  const auto line = [&](std::size_t index) {
    return std::string(text.line(index)).append("|").append(text.line_end(index));
  };
  ASSERT_EQ(text.size(), 7U);
  EXPECT_EQ(line(0), "A|\r\n");
  EXPECT_EQ(line(1), "B|\r");
  EXPECT_EQ(line(2), "|\r");
  EXPECT_EQ(line(3), "C|\n");
  EXPECT_EQ(line(4), "|\r\n");
  EXPECT_EQ(line(5), "|\n");
  EXPECT_EQ(line(6), "D|");
  EXPECT_EQ(ProgramText({}, "A\r").size(), 1U);
  EXPECT_EQ(ProgramText({}, "").size(), 0U);
}

}  // namespace
}  // namespace trc
