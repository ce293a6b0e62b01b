#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "tests/programs/computing.h"

// Texts of Fanuc with several programs: what stands after an O, where the main program is, and
// what becomes of the others.

namespace trc::support::fanuc_programs {
namespace {

ProgramSessionSetup fanuc() { return computing_setup(DialectName::fanuc); }
ProgramSessionSetup fanuc_with(std::map<std::string, double> variables) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.variables = std::move(variables);
  return setup;
}

std::string flat(const std::string& text) { return flat_of(text, fanuc()); }
std::pair<int, unsigned> told(const std::string& text) { return refusal_of(text, fanuc()); }
std::string detail_of(const std::string& text, const ProgramSessionSetup& setup) {
  const ProgramRun ran = to_text(text, setup);
  const auto error = std::ranges::find(ran.diagnostics, Severity::error, &Diagnostic::severity);
  return error == ran.diagnostics.end() ? ran.text : error->detail;
}

TEST(FanucHeads, HaveWordsAfterThemThatAreExecuted) {
  const std::string main = "O1\nM98 P100\nM30\n";
  EXPECT_EQ(flat(main + "O0100 G90 G1 X5. F300.\nM99\n"), "O1\n(O0100)\nG90 G1 X5. F300.\nM30\n");
  EXPECT_EQ(flat(main + ":0100 G90 G1 X5. F300.\nM99\n"), "O1\n(O0100)\nG90 G1 X5. F300.\nM30\n");
  EXPECT_EQ(flat(main + "O0100 (SUB) N10 G91 G1 Z-1.\nM99\n"),
            "O1\n(O0100)\n(SUB) N10 G91 G1 Z-1.\nM30\n");
  EXPECT_EQ(flat(main + "O100N10G91G1Z-1.M99\n"), "O1\n(O0100)\nN10G91G1Z-1.\nM30\n");
  EXPECT_EQ(flat("O1\n#1=3\nM98 P100\nM30\nO0100 #2=#1*2\nG0 X#2\nM99\n"),
            "O1\n(O0100)\nG0 X6.\nM30\n");
  EXPECT_EQ(flat("M98 <A>\nM30\nO<A> G0 X5.\nM99\n"), "(O<A>)\nG0 X5.\nM30\n");
  EXPECT_EQ(flat(main + "O0100 G0 X5. M99\n"), "O1\n(O0100)\nG0 X5.\nM30\n");
  ProgramSessionSetup setup = fanuc();
  setup.session.program.subprograms = {{"O0100.nc", "%\nO0100 G0 X5.\nM99\n%\n"}};
  EXPECT_EQ(flat_of(main, setup), "O1\n(O0100)\nG0 X5.\nM30\n");
}

// Lines that wait for the main program come before a last line without a line end, or of one
// that ends in a carriage return.
TEST(FanucHeads, KeepAllLinesThatWaitAfterThem) {
  const std::string lines = "O1\nG90 G0 X1.\nX2.\nT1\nX3.\nG0 Z50.";
  EXPECT_EQ(flat(lines), lines);
  EXPECT_EQ(flat("O1\nG90 G0 X1.\nG0 Z50."), "O1\nG90 G0 X1.\nG0 Z50.");
  std::string of_returns = lines;
  std::ranges::replace(of_returns, '\n', '\r');
  EXPECT_EQ(flat(of_returns), of_returns);
  // The end of a subprogram, and what calls it, need no line end either.
  EXPECT_EQ(flat("O7\nG0 X1.\nM99\nO1\nM98 P7\nM30"), "O1\n(O0007)\nG0 X1.\nM30\n");
}

TEST(FanucHeads, OfSubprogramsMayBeJumpedTo) {
  EXPECT_EQ(flat("O1\nM98 P100\nM30\nO0100 N10 #1=#1+1\nG0 X#1\nIF [#1 LT 2] GOTO 10\nM99\n"),
            "O1\n(O0100)\nG0 X1.\nG0 X2.\nM30\n");
  EXPECT_EQ(flat("O1\nM98 P100 L2\nM30\nO0100 G91 X1.\nM99\n"),
            "O1\n(O0100)\nG91 X1.\n(O0100)\nG91 X1.\nM30\n");
}

TEST(FanucHeads, OfTheMainProgramComeOutOnce) {
  EXPECT_EQ(flat("O1000 #1=5\nG0 X#1\nM30\n"), "O1000\nG0 X5.\nM30\n");
  EXPECT_EQ(flat("O1000 G0 X[1+1]\nM30\n"), "O1000\nG0 X2.\nM30\n");
  EXPECT_EQ(flat("O1000 N5 #1=#1+1\nG0 X#1\nIF [#1 LT 2] GOTO 5\nM30\n"),
            "O1000\nG0 X1.\nG0 X2.\nM30\n");
  EXPECT_EQ(flat("O1000 M98 P2\nM30\nO2\nG0 X1.\nM99\n"), "O1000\n(O0002)\nG0 X1.\nM30\n");
  EXPECT_EQ(flat("O1000 G21 G90 (A)\nG0 X[1+1]\nM30\n"), "O1000 G21 G90 (A)\nG0 X2.\nM30\n");
}

const std::string contour = "G1 G41 D1 X0 Y-10. F300.\nY40.\nX60.\nY0\nX-10.\nG40 X-20. Y-20.\n";
const std::string main_program =
    "O1000 (MAIN)\nG21 G90 G17 G40\nG54 G0 X-20. Y-20.\nZ-3.\nM98 P0100\nG0 Z50.\nM30\n";

// As a memory card has them, in the order of their numbers.
TEST(FanucMainPrograms, MayStandAfterWhatTheyCall) {
  const std::string behind =
      to_text(main_program + "O0100 (SUB)\n" + contour + "M99\n", fanuc()).text;
  for (const std::size_t piece : {0U, 1U, 7U}) {
    const ProgramRun ran =
        to_text("%\nO0100 (SUB)\n" + contour + "M99\n" + main_program + "%\n", fanuc(), piece);
    EXPECT_FALSE(ran.stopped) << ran.report();
    EXPECT_EQ(ran.text, "%\n" + behind + "%\n");
  }
  EXPECT_EQ(flat("O0100\nG0 X#24\nM99\nO1000\nG65 P100 X5.\nM30\n"),
            "O1000\n(O0100)\nG0 X5.\nM30\n");
  EXPECT_EQ(flat("O0100\nM98 P200\nM99\nO0200\nG0 X5.\nM99\nO1000\nM98 P100\nM30\n"),
            "O1000\n(O0100)\n(O0200)\nG0 X5.\nM30\n");
  EXPECT_EQ(flat("O<SUB>\nG0 X5.\nM99\nO<MAIN>\nM98 <SUB>\nM30\n"),
            "O<MAIN>\n(O<SUB>)\nG0 X5.\nM30\n");
}

TEST(FanucMainPrograms, ThatAreNotTheOnlyOneAreRefused) {
  const std::string sub = "O0100 (SUB)\nG0 X1.\nM99\n";
  EXPECT_EQ(told(sub + "O1000\nM98 P100\nM30\nO2000\nM98 P100\nM30\n"), std::pair(900003, 1U));
  EXPECT_EQ(told(sub + "O1000\nM98 P100\nM99\n"), std::pair(900003, 1U));
  // What has gone on before it was known.
  EXPECT_EQ(told("O0100\nT1 M6\nG0 X1.\nM99\nO1000\nM98 P100\nM30\n"), std::pair(900003, 6U));
  EXPECT_EQ(told("O0100\nT1 M6\nG0 X[1+1]\nM99\nO1000\nM98 P100\nM30\n"), std::pair(900003, 5U));
  std::string lines;
  while (lines.size() < 70'000) lines += "G0 X1. Y2. Z3.\n";
  EXPECT_EQ(told("O0100\n" + lines + "M99\nO1000\nM98 P100\nM30\n").first, 900003);
  EXPECT_EQ(told("O0100\n" + lines + "G0 X[1+1]\nM99\nO1000\nM98 P100\nM30\n").first, 900003);
  EXPECT_EQ(detail_of(sub + "O1000\nM98 P100\nM30\nO2000\nM98 P100\nM30\n", fanuc()),
            "O0100, a subprogram before several main programs: O1000, O2000");
}

// Without a call the first one is a program of its own, as ever.
TEST(FanucMainPrograms, StandFirstElse) {
  EXPECT_EQ(flat("O0100\nG0 X1.\nM99\nO1000\nG0 X2.\nM30\n"),
            "O0100\nG0 X1.\nM99\nO1000\nG0 X2.\nM30\n");
  EXPECT_EQ(told("O0100\nG0 X1.\nM99\nO1000\n" + contour + "M30\n"), std::pair(900015, 5U));
  EXPECT_EQ(flat("O0100\nG0 X#1 Y2.\nM99\nO1000\nG0 X2.\nM30\n"),
            "O0100\nG0 Y2.\nM99\nO1000\nG0 X2.\nM30\n");
}

TEST(FanucPrograms, ThatNothingResolvesComeOutAsTheyStand) {
  const std::string rest = "O7100\nG1 Y30.\nM99\nO1001 (TWO)\n#1=5\nG0 X#1\nM30\n";
  EXPECT_EQ(flat("%\nO1000\n#1=5.\nG0 X#1\nM30\n" + rest + "%\n"),
            "%\nO1000\nG0 X5.\nM30\n" + rest + "%\n");
  // What was resolved goes, unless what is kept calls it.
  EXPECT_EQ(flat("O1\nM98 P2\nM30\nO2\nG0 X1.\nM99\nO3\nG0 X2.\nM99\n"),
            "O1\n(O0002)\nG0 X1.\nM30\nO3\nG0 X2.\nM99\n");
  EXPECT_EQ(flat("O1\nM98 P2\nM30\nO2\nG0 X1.\nM99\nO3\nM98 P2\nM30\n"),
            "O1\n(O0002)\nG0 X1.\nM30\nO2\nG0 X1.\nM99\nO3\nM98 P2\nM30\n");
  // A call under a condition that does not hold.
  EXPECT_EQ(flat("O1\n#1=1\nIF [#1 EQ 1] GOTO 5\nM98 P2\nN5 M30\nO2\n" + contour + "M99\n"),
            "O1\nN5 M30\n");
}

TEST(FanucPrograms, ThatTheMachineMillsStay) {
  const std::string pocket = "O7100\nG1 Y30.\nX10.\nM99\n";
  const std::string text = flat(
      "O1\n#1=5.\nG21 G90 G17\nG0 X#1 Y0\nG150 X30. Y20. Z-5. J3. K.5 Q1. "
      "R1. D0 F200. P7100\nM30\n" +
      pocket);
  EXPECT_TRUE(text.ends_with("M30\n" + pocket)) << text;
}

TEST(FanucPrograms, WithAContourThatNothingResolvesAreRefused) {
  EXPECT_EQ(told("O1\n#1=5\nG0 X#1\nM30\nO2\nG21 G90 G17\n" + contour + "M99\n"),
            std::pair(900015, 7U));
  EXPECT_EQ(told("O1\nM98 P2\nM30\nO2\nG21 G90 G17\n" + contour + "M99\nO3\nM98 P2\nM30\n").first,
            900015);
}

TEST(FanucSystemVariables, HoldTheWordsThatTheProgramHasSaid) {
  EXPECT_EQ(flat("T3 M6\nS1500 M3\nG1 X1. F250.\nG43 H7\n#1=#4120\nG0 X#1 Y#4109 A#4111\n"
                 "Y#4119 A#4113\n"),
            "T3 M6\nS1500 M3\nG1 X1. F250.\nG43 H7\nG0 X3. Y250. A7.\nY1500. A3.\n");
  EXPECT_EQ(flat("T1 M6\nG43 H#4120 Z5.\nT2 M6\nG43 H#4120 Z5.\nM30\n"),
            "T1 M6\nG43 H1 Z5.\nT2 M6\nG43 H2 Z5.\nM30\n");
  EXPECT_EQ(flat("G0 X1. D5\n#2=#4107\nY#2\n"), "G0 X1. D5\nY5.\n");
  // What an expression has said counts as well.
  EXPECT_EQ(flat("#1=4\nT[#1*2] M6\nG0 X#4120\n"), "T8 M6\nG0 X8.\n");
}

TEST(FanucSystemVariables, ThatAreNotKnownAreRefused) {
  EXPECT_EQ(told("G0 X1.\nH#4120\nT1 M6\n"), std::pair(900307, 2U));
  // A tool beside it, of which nobody says which one counts.
  EXPECT_EQ(told("T1 M6\nT2 M6 G43 H#4120 Z1.\n"), std::pair(900307, 2U));
  EXPECT_EQ(told("/T1 M6\nH#4120\n"), std::pair(900307, 2U));
  EXPECT_EQ(told("T1 M6\nM98 P9000\nH#4120\n"), std::pair(900307, 3U));
}

// One value cannot hold everywhere.
TEST(FanucSystemVariables, ThatTheProgramChangesCannotBeGiven) {
  const std::string text = "G0 X1.\nH#4120\nT1 M6\nH#4120\n";
  EXPECT_EQ(refusal_of(text, fanuc_with({{"4120", 1}})), std::pair(900307, 4U));
  EXPECT_EQ(detail_of(text, fanuc_with({{"4120", 1}})), "#4120, which the program itself changes");
  EXPECT_EQ(flat_of("G0 X1.\nH#4120\nM30\n", fanuc_with({{"4120", 1}})), "G0 X1.\nH1\nM30\n");
  EXPECT_EQ(refusal_of("G0 X1.\n#1=#5041\n", fanuc_with({{"5041", 7}})), std::pair(900307, 2U));
}

TEST(FanucSystemVariables, HoldWhereThePathHasLedTo) {
  EXPECT_EQ(flat("G21 G90\nG0 X1.5 Y-2. Z3.\n#1=#5001\nG0 X[#5041+1] Y#5042 Z#5003\nM30\n"),
            "G21 G90\nG0 X1.5 Y-2. Z3.\nG0 X2.5 Y-2. Z3.\nM30\n");
  EXPECT_EQ(flat("G20 G90\nG0 X1.5 Y-2.\nG91 X0.25\nG90 Y#5001\nM30\n"),
            "G20 G90\nG0 X1.5 Y-2.\nG91 X0.25\nG90 Y1.75\nM30\n");
  // An axis without a place, a length, another origin, another frame.
  EXPECT_EQ(told("G0 X1.\n#1=#5042\n"), std::pair(900307, 2U));
  EXPECT_EQ(told("G91 G0 X1.\n#1=#5041\n"), std::pair(900307, 2U));
  EXPECT_EQ(told("G0 Z1.\nG43 H1 Z5.\n#1=#5043\n"), std::pair(900307, 3U));
  EXPECT_EQ(told("G0 X1.\nG28 X0\n#1=#5041\n"), std::pair(900307, 3U));
  EXPECT_EQ(told("G0 X1. Y1.\nG68 X0 Y0 R30.\nG0 X1. Y1.\n#1=#5041\n"), std::pair(900307, 4U));
  EXPECT_EQ(told("G21 G90 G17\nG0 X-20. Y-20.\nG1 G41 D1 X0 Y-10. F300.\nY40.\nX#5041\nX60.\n"
                 "G40 X80.\nM30\n"),
            std::pair(900307, 5U));
}

// The follow-up of a tool that is not known is not told.
TEST(FanucSystemVariables, ThatAreNotKnownTellNothingOfTools) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools = {{12, ToolRow(6)}};
  const ProgramRun ran = to_text(
      "G21 G90 G17\nG0 X-20. Y-20.\nG1 G41 D#4120 X0 Y-10. F300.\nY40.\n"
      "G40 X-20.\nM30\n",
      setup);
  ASSERT_EQ(ran.diagnostics.size(), 1U) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].code, Code::machine_state);
}

TEST(FanucWords, TakeNoMoreDigitsThanAControlHas) {
  EXPECT_EQ(flat("#1=1000.\nG4 P[#1/3]\nG83 X0 Y0 Z-5. R1. P[#1/3] F[#1/3]\nG80\n"),
            "G4 P333\nG83 X0 Y0 Z-5. R1. P333 F333.3333\nG80\n");
  EXPECT_EQ(flat("G20\nG1 X1. F[10/3]\n"), "G20\nG1 X1. F3.333333\n");
  EXPECT_EQ(told("M98 P[10/3]\n"), std::pair(900309, 1U));
}

TEST(FanucLoops, OfAProductionLineEndTheProgram) {
  const std::string part = "N10 G0 X-20. Y-20.\n" + contour + "G0 Z50.\n";
  const ProgramRun endless = to_text("O1000\nG21 G90 G17\n" + part + "M99 P10\n", fanuc());
  EXPECT_FALSE(endless.stopped) << endless.report();
  EXPECT_TRUE(endless.text.ends_with("G0 Z50.\nM99 P10\n")) << endless.text;
  EXPECT_EQ(flat("N10 G0 X1.\nM98 P2\nM99 P10\nO2\nY1.\nM99\n"),
            "N10 G0 X1.\n(O0002)\nY1.\nM99 P10\n");
  // Rounds that differ, and a number that came out twice.
  EXPECT_EQ(told("#1=0\nN10 #1=#1+1\nG0 X#1\nM99 P10\n"), std::pair(900003, 4U));
  EXPECT_EQ(told("N10 G0 X1.\nM98 P2\nM99 P10\nO2\nN10 Y1.\nM99\n"), std::pair(900003, 3U));
  // Others have an end, or go ahead.
  EXPECT_EQ(flat("#1=0\nN10 #1=#1+1\nG0 X#1\nIF [#1 GE 2] GOTO 20\nM99 P10\nN20 M30\n"),
            "G0 X1.\nG0 X2.\nN20 M30\n");
  EXPECT_EQ(flat("G0 X1.\nM99 P20\nG0 X2.\nN20 M30\n"), "G0 X1.\nN20 M30\n");
}

TEST(FanucRemedies, SpeakOfWhatStandsThere) {
  const auto help = [](const std::string& text, const ProgramSessionSetup& setup) {
    const ProgramRun ran = to_text(text, setup);
    return ran.diagnostics.empty() ? ran.text : help_of(ran.diagnostics[0], Language::english);
  };
  EXPECT_TRUE(help("M98 P2 Q100\nM30\nO2\nM99\n", fanuc()).starts_with("Take the word out"));
  ProgramSessionSetup increments = fanuc();
  increments.session.program.whole_numbers = WholeNumbers::increments;
  EXPECT_TRUE(help("G65 P2 X10\nM30\nO2\nM99\n", increments).starts_with("Write the argument"));
  const std::string unknown = "G54\nG90 G0 Y-20.\nG91 G1 X1. F100.\nM30\n";
  EXPECT_TRUE(detail_of(unknown, fanuc()).starts_with("X, unknown since the change in line 1"));
  EXPECT_NE(help(unknown, fanuc()).find("the axis that is named"), std::string::npos);
}

}  // namespace
}  // namespace trc::support::fanuc_programs
