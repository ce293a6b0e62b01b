#include "core/nc/program/flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// What is executed, line by line; tests/programs looks at whole programs.

namespace trc::program {
namespace {

ProgramSetup of_fanuc() {
  ProgramSetup setup;
  setup.dialect = DialectName::fanuc;
  return setup;
}

// A flow of Fanuc from the first line of its text on.
class Execution {
 public:
  explicit Execution(std::string text, ProgramSetup setup = of_fanuc())
      : setup_(std::move(setup)),
        flow_(make_flow(setup_, {.calls = calls_, .checkpoint = checkpoint_},
                        ProgramText("", std::move(text)), 0, FirstBlock::in_text)) {}

  [[nodiscard]] Flow& flow() { return *flow_; }
  // What the next line becomes.
  std::string next() {
    std::string flat;
    last_ = flow_->step(flat);
    return flat;
  }
  // What all lines become, up to an end or a refusal.
  std::string rest() {
    std::string flat;
    do flat += next();
    while (last_ == Flow::Step::goes_on);
    return flat;
  }
  [[nodiscard]] Flow::Step last() const { return last_; }
  // The place in the program of each line that is executed.
  std::vector<std::uint32_t> places() {
    std::vector<std::uint32_t> found;
    while (next(), last_ == Flow::Step::goes_on) found.push_back(flow_->line_in_program());
    return found;
  }

 private:
  ProgramSetup setup_;
  CallPlaces calls_;
  Checkpoint checkpoint_{{}};
  std::unique_ptr<Flow> flow_;
  Flow::Step last_ = Flow::Step::goes_on;
};

TEST(Flow, TurnsALineThatComputesIntoItsValues) {
  Execution execution("#1=2\nG0 X#1\nM30\n");
  EXPECT_EQ(execution.rest(), "G0 X2.\nM30\n");
  EXPECT_EQ(execution.last(), Flow::Step::ended);
}

TEST(Flow, KnowsWhetherALineStaysAsItIsWritten) {
  Execution execution("G0 X1.\n#1=2\nG0 X#1\nM30\n");
  EXPECT_EQ(execution.next(), "G0 X1.\n");
  EXPECT_TRUE(execution.flow().is_as_written());
  EXPECT_EQ(execution.next(), "");
  EXPECT_EQ(execution.next(), "G0 X2.\n");
  EXPECT_FALSE(execution.flow().is_as_written());
}

TEST(Flow, FollowsLoopsAndJumps) {
  Execution loop("#1=0\nWHILE [#1 LT 3] DO1\n#1=#1+1\nG0 X#1\nEND1\nM30\n");
  EXPECT_EQ(loop.rest(), "G0 X1.\nG0 X2.\nG0 X3.\nM30\n");
  Execution jump("#1=1\nGOTO 20\nG0 X1.\nN20 G0 X2.\nM30\n");
  EXPECT_EQ(jump.rest(), "N20 G0 X2.\nM30\n");
}

TEST(Flow, StandsInTheProgramWhereItsLineDoes) {
  Execution execution("#1=0\nN10 #1=#1+1\nIF [#1 LT 2] GOTO 10\nM30\n");
  EXPECT_EQ(execution.places(), (std::vector<std::uint32_t>{1, 2, 3, 2, 3}));
}

TEST(Flow, CountsTheLinesThatItExecutes) {
  Execution execution("#1=0\nN10 #1=#1+1\nIF [#1 LT 2] GOTO 10\nM30\n");
  execution.rest();
  EXPECT_EQ(execution.flow().executed_lines(), 6U);
}

TEST(Flow, IsRefusedBeyondTheLinesThatTheSetupAllows) {
  ProgramSetup setup = of_fanuc();
  setup.max_executed_lines = 100;
  Execution execution("N10 G0 X1.\nGOTO 10\n", setup);
  execution.rest();
  EXPECT_EQ(execution.last(), Flow::Step::refused);
  ASSERT_EQ(execution.flow().refusals().size(), 1U);
  EXPECT_EQ(execution.flow().refusals()[0].code, Code::too_many_lines_executed);
}

TEST(Flow, CallsSubprogramsOfTheTextAndOfTheSetup) {
  Execution of_text("M98 P1 L2\nM30\nO1\nG0 X1.\nM99\n");
  EXPECT_NE(of_text.rest().find("G0 X1.\n"), std::string::npos);
  ProgramSetup setup = of_fanuc();
  setup.subprograms["O7"] = "O7\nG0 X7.\nM99\n";
  Execution of_setup("G65 P7\nM30\n", setup);
  EXPECT_NE(of_setup.rest().find("G0 X7.\n"), std::string::npos);
}

TEST(Flow, StandsAtTheCallWhileAGivenSubprogramIsExecuted) {
  ProgramSetup setup = of_fanuc();
  setup.subprograms["O7"] = "O7\nG0 X7.\nM99\n";
  Execution execution("#1=1\nG65 P7\nM30\n", setup);
  std::string flat;
  while (flat.find("X7.") == std::string::npos && execution.last() == Flow::Step::goes_on)
    flat = execution.next();
  EXPECT_EQ(execution.flow().line_in_program(), 2U);
  EXPECT_EQ(execution.flow().line_within(), 2U);
  EXPECT_NE(execution.flow().chain(), CallPlaces::main_program);
}

TEST(Flow, IsRefusedWhereCallsHaveNoEnd) {
  Execution execution("M98 P1\nM30\nO1\nM98 P1\nM99\n");
  execution.rest();
  EXPECT_EQ(execution.last(), Flow::Step::refused);
  ASSERT_EQ(execution.flow().refusals().size(), 1U);
  EXPECT_EQ(execution.flow().refusals()[0].code, Code::calls_too_deep);
}

TEST(Flow, TakesTheValuesThatTheSetupGives) {
  ProgramSetup setup = of_fanuc();
  setup.variables["#500"] = 3;
  Execution execution("G0 X#500\nM30\n", setup);
  EXPECT_EQ(execution.rest(), "G0 X3.\nM30\n");
}

TEST(Flow, KnowsTheModesThatItIsGiven) {
  Execution execution("#1=#4003\nG0 X#1\nM30\n");
  execution.flow().hold({.incremental = true});
  EXPECT_EQ(execution.rest(), "G0 X91.\nM30\n");
}

TEST(Flow, LooksAfterARefusalForWhateverElseStandsAgainstTheProgram) {
  Execution execution("#1=1/0\nG0 X1.\n#2=SQRT[-1]\nM30\n");
  execution.rest();
  ASSERT_EQ(execution.last(), Flow::Step::refused);
  ASSERT_EQ(execution.flow().refusals().size(), 1U);
  EXPECT_EQ(execution.flow().refusals()[0].code, Code::division_by_zero);
  execution.flow().look_ahead();
  std::vector<Code> found;
  for (int lines = 0; lines < 20 && execution.last() != Flow::Step::ended; ++lines) {
    execution.next();
    for (const Diagnostic& refusal : execution.flow().refusals()) found.push_back(refusal.code);
  }
  EXPECT_EQ(execution.last(), Flow::Step::ended);
  EXPECT_NE(std::ranges::find(found, Code::value_invalid), found.end());
}

TEST(ComputingLine, IsOneWithAVariableAJumpOrACall) {
  const ProgramSetup setup = of_fanuc();
  for (const std::string_view line :
       {"#1=2", "G0 X#1", "GOTO 10", "N10 M98 P1", "IF [1 EQ 1] GOTO 2"})
    EXPECT_TRUE(computes(setup, line)) << line;
  for (const std::string_view line : {"G0 X1.", "N10 (#1=2)", "M30", ""})
    EXPECT_FALSE(computes(setup, line)) << line;
}

}  // namespace
}  // namespace trc::program
