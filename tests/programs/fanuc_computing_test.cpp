#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/programs/computing.h"
#include "tests/programs/twins.h"

namespace trc::support::fanuc_computing {
namespace {

ProgramSessionSetup fanuc() { return computing_setup(DialectName::fanuc); }

std::string flat(const std::string& text) { return flat_of(text, fanuc()); }

// The value of an expression, as it is written after an address.
std::string value_of(const std::string& expression) {
  const std::string text = flat("#1=3.5\n#2=-2\n#10=" + expression + "\nG0 X[#10+0]\n");
  return text.starts_with("G0 X") ? text.substr(4, text.size() - 5) : text;
}

TEST(FanucExpressions, KeepTheOrderOfTheirOperators) {
  EXPECT_EQ(value_of("1+2*3"), "7.");
  EXPECT_EQ(value_of("[1+2]*3"), "9.");
  EXPECT_EQ(value_of("10-4-3"), "3.");
  EXPECT_EQ(value_of("16/4/2"), "2.");
  EXPECT_EQ(value_of("-#2*3"), "6.");
  EXPECT_EQ(value_of("#1-#2"), "5.5");
  EXPECT_EQ(value_of("6 OR 1 AND 5"), "7.");
  EXPECT_EQ(value_of("6 XOR 3"), "5.");
  EXPECT_EQ(value_of("27 MOD 20"), "7.");
  EXPECT_EQ(value_of("-7 MOD 3"), "-1.");
}

TEST(FanucExpressions, KnowTheFunctions) {
  EXPECT_EQ(value_of("SIN[30]"), "0.5");
  EXPECT_EQ(value_of("COS[60]*2"), "1.");
  EXPECT_EQ(value_of("TAN[45]"), "1.");
  EXPECT_EQ(value_of("ASIN[0.5]"), "30.");
  EXPECT_EQ(value_of("ACOS[-1]"), "180.");
  EXPECT_EQ(value_of("ATAN[1]"), "45.");
  EXPECT_EQ(value_of("ATAN[1]/[-1]"), "135.");
  EXPECT_EQ(value_of("ATAN[-1]/[-1]"), "225.");
  EXPECT_EQ(value_of("SQRT[2.25]"), "1.5");
  EXPECT_EQ(value_of("ABS[#2]"), "2.");
  EXPECT_EQ(value_of("ROUND[2.5]"), "3.");
  EXPECT_EQ(value_of("ROUND[-2.5]"), "-3.");
  EXPECT_EQ(value_of("FIX[2.9]"), "2.");
  EXPECT_EQ(value_of("FIX[-2.9]"), "-2.");
  EXPECT_EQ(value_of("FUP[2.1]"), "3.");
  EXPECT_EQ(value_of("FUP[-2.1]"), "-3.");
  EXPECT_EQ(value_of("LN[EXP[2]]"), "2.");
  EXPECT_EQ(value_of("POW[2,10]"), "1024.");
  EXPECT_EQ(value_of("BCD[25]"), "37.");
  EXPECT_EQ(value_of("BIN[37]"), "25.");
}

// The text after the end of the main program is no part of it only where nothing is lost.
TEST(FanucPrograms, LoseNoContourAfterTheirEnd) {
  const std::string contour =
      "G21 G90 G17\nG0 X-20. Y-20.\nG41 D1 G1 X0 Y0 F300.\nY40.\nG40 X80.\n";
  const auto told = [](const std::string& text) { return refusal_of(text, fanuc()); };
  // A second program of a memory card.
  EXPECT_EQ(told("O0001\n#101=5\nG0 X#101\nM30\nO0002\n" + contour + "M30\n"),
            std::pair(900015, 8U));
  EXPECT_EQ(told("#101=5\nG0 X#101\nM30\n" + contour + "M30\n"), std::pair(900015, 6U));
  // Without an end it runs into what comes next, whatever that is.
  EXPECT_EQ(told("#101=5\nG0 X#101\nO1000\n" + contour + "M99\n"), std::pair(900003, 3U));
  EXPECT_EQ(told("#101=5\nG21 G90 G17\no100 sub\n  G0 X#1\no100 endsub\n" + contour + "M2\n"),
            std::pair(900003, 3U));
  // A subprogram that nobody calls, which nothing resolves.
  EXPECT_EQ(told("#101=5\nG0 X#101\nM30\nO1000\n" + contour + "M99\n"), std::pair(900015, 7U));
}

// Controls from the 30i on: a name in place of the number.
TEST(FanucPrograms, MayHaveNames) {
  EXPECT_EQ(flat("O<MAIN>\nM98 <SUB1> L2 (A)\nM30\nO<SUB1>\nG91 X1.\nM99\n"),
            "O<MAIN>\n(O<SUB1>) (A)\nG91 X1.\n(O<SUB1>)\nG91 X1.\nM30\n");
  EXPECT_EQ(flat("<MAIN>\nN5 m98<sub1>\nM30\n<SUB1>\nG0 X1.\nM99\n"),
            "<MAIN>\nN5 (O<SUB1>)\nG0 X1.\nM30\n");
  EXPECT_EQ(refusal_of("M98 <SUB2>\nM30\nO<SUB1>\nM99\n", fanuc()), std::pair(900306, 1U));
  EXPECT_EQ(refusal_of("M98 <SUB1> X5\nM30\nO<SUB1>\nM99\n", fanuc()), std::pair(900309, 1U));
}

// D-48: 0.1 ten times is not quite 1 in binary digits, but it is in those of the control.
TEST(FanucExpressions, CountInDecimalDigits) {
  EXPECT_EQ(flat("#1=0\nWHILE [#1 LT 1] DO1\nG0 X#1\n#1=#1+0.1\nEND1\nM30\n"),
            "G0 X0.\nG0 X0.1\nG0 X0.2\nG0 X0.3\nG0 X0.4\nG0 X0.5\nG0 X0.6\nG0 X0.7\nG0 X0.8\n"
            "G0 X0.9\nM30\n");
  EXPECT_EQ(value_of("FIX[[0.1+0.2]*10]"), "3.");
  EXPECT_EQ(flat("IF [0.1+0.2 EQ 0.3] GOTO 5\nG0 X1.\nN5 M30\n"), "N5 M30\n");
}

TEST(FanucBranches, MayTakeSeveralLines) {
  const auto taken = [](const std::string& condition) {
    return flat("#1=3\nIF [" + condition +
                "] THEN\nG0 X1.\nIF [#1 EQ 3] THEN (A)\nG0 X2.\nENDIF\nELSE\nG0 X3.\nENDIF\n"
                "IF [#1 EQ 4] THEN\nG0 X4.\nENDIF (B)\nIF [#1 EQ 3] THEN #1=5\nG0 X#1\nM30\n");
  };
  EXPECT_EQ(taken("#1 EQ 3"), "G0 X1.\n(A)\nG0 X2.\nG0 X5.\nM30\n");
  EXPECT_EQ(taken("#1 EQ 2"), "G0 X3.\nG0 X5.\nM30\n");
  EXPECT_EQ(refusal_of("#1=3\nIF [#1 EQ 2] THEN\nG0 X1.\nM30\n", fanuc()), std::pair(900310, 2U));
  EXPECT_EQ(refusal_of("#1=3\nELSE\nG0 X1.\nM30\n", fanuc()), std::pair(900310, 2U));
}

TEST(FanucVariables, ThatAreVacantLeaveTheirWordsOut) {
  EXPECT_EQ(flat("G0 X#1 Y2. Z#0 (A)\nM30\n"), "G0 Y2. (A)\nM30\n");
  EXPECT_EQ(flat("#1=#2\nG0 X#1 Y[#1+1]\n#1=#2*1\nG0 X#1\n"), "G0 Y1.\nG0 X0.\n");
  EXPECT_EQ(flat("N5 X#1\nN6 X#1 (B)\nM30\n"), "N6 (B)\nM30\n");
}

TEST(FanucVariables, ThatAreVacantEqualNothingElse) {
  const auto holds = [](const std::string& condition) {
    return flat("#2=0\nIF [" + condition + "] GOTO 5\nG0 X1.\nN5 M30\n") == "N5 M30\n";
  };
  EXPECT_TRUE(holds("#1 EQ #0"));
  EXPECT_FALSE(holds("#1 EQ 0"));
  EXPECT_TRUE(holds("#1 NE 0"));
  EXPECT_FALSE(holds("#1 NE #0"));
  EXPECT_FALSE(holds("#2 EQ #0"));
  EXPECT_TRUE(holds("#2 EQ 0"));
  EXPECT_TRUE(holds("#2 NE #0"));
  EXPECT_TRUE(holds("#1 GE #0"));
  EXPECT_TRUE(holds("#1 LE 0"));
  EXPECT_FALSE(holds("#1 GT 0"));
  EXPECT_TRUE(holds("[#2 EQ 0] AND [#1 EQ #0]"));
  EXPECT_TRUE(holds("[#2 EQ 1] OR [#1 EQ #0]"));
}

TEST(FanucVariables, AreNamedByWhatIsComputed) {
  EXPECT_EQ(flat("#1=100\n#[#1+2]=7\n#101=102\nG0 X#102 Y#[#101]\n"), "G0 X7. Y7.\n");
}

TEST(FanucVariables, HaveTheValuesOfTheSetup) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.variables = {{"#500", 12.5}, {"5041", -3}, {"#1", 4}};
  EXPECT_EQ(flat_of("#100=#5041\nG0 X#500 Y#100 Z#1\n", setup), "G0 X12.5 Y-3. Z4.\n");
}

TEST(FanucVariables, KnowTheModesInForce) {
  EXPECT_EQ(flat("G21 G91 G18\nG1 X1. F100\n#1=#4001\n#2=#4003\nG90 G0 Y1.\nG#1 G#2 X1. "
                 "A[#4002] B[#4006]\n"),
            "G21 G91 G18\nG1 X1. F100\nG90 G0 Y1.\nG1 G91 X1. A18. B21.\n");
}

TEST(FanucWords, AreWrittenAsTheControlTakesThem) {
  EXPECT_EQ(flat("#1=3\nG#1 X[1/3] Y#1 R-#1 F[#1*100] S[#1*1000.1] M[#1] T#1 D#1\n"),
            "G3 X0.33333333 Y3. R-3. F300. S3000 M3 T3 D3\n");
  EXPECT_EQ(flat("G21\nG0 X[ROUND[1.00333]+ROUND[1.00333]]\n"), "G21\nG0 X2.006\n");
  EXPECT_EQ(flat("G20\nG0 X[ROUND[1.00333]+ROUND[1.00333]]\n"), "G20\nG0 X2.0066\n");
}

TEST(FanucStatements, LeaveTheirCommentsAndNumbers) {
  EXPECT_EQ(flat("N1 #1=5\nN2 #2=6 (SIX)\nN3 IF [#1 EQ 4] GOTO 9 (NO)\nN9 M30\n"),
            "N2 (SIX)\nN3 (NO)\nN9 M30\n");
}

TEST(FanucStatements, AreKnownByTheirFirstTwoLetters) {
  EXPECT_EQ(flat("#1=0\nWH[#1 LT 2]DO1\n#1=#1+1\nG0 X#1\nEND1\nGO10\nG0 X9.\nN10 M30\n"),
            "G0 X1.\nG0 X2.\nN10 M30\n");
  EXPECT_EQ(flat("#1=1\nIF[#1 EQ 1]GO 10\nG0 X9.\nN10 M30\n"), "N10 M30\n");
  EXPECT_EQ(flat("G0 X[AB[-3]+SQ[4]+RO[1.6]+FI[1.9]+FU[1.1]]\n"), "G0 X9.6\n");
  EXPECT_EQ(flat("G0 X[SI[90]+CO[0]+TA[45]] Y[AC[0]+AS[1]+AT[1]/[1]]\n"), "G0 X3. Y225.\n");
}

// D-169
TEST(FanucVariables, KnowTheRegistersThatTheProgramHasWritten) {
  const auto told = [](const std::string& text) { return refusal_of(text, fanuc()); };
  EXPECT_EQ(flat("G21 G90\nG10 L12 P5 R5.\n#100=#13005\nG0 X#100\n"),
            "G21 G90\nG10 L12 P5 R5.\nG0 X5.\n");
  EXPECT_EQ(flat("G21 G90\n#13005=3.\nG10 L12 P5 R5.\nG10 L13 P5 R.1\nG0 X[#13005+#12005]\n"),
            "G21 G90\nG10 L12 P5 R3.\nG10 L12 P5 R5.\nG10 L13 P5 R.1\nG0 X5.1\n");
  EXPECT_EQ(told("G21 G90\n#100=#13005\n"), std::pair(900307, 2U));
  EXPECT_EQ(told("G21 G90\nG10 L12 P5 R5.\n#100=#13006\n"), std::pair(900307, 3U));
  EXPECT_EQ(told("G21 G90\nG10 L12 P5 R5.\nG20\n#100=#13005\n"), std::pair(900307, 4U));
  EXPECT_EQ(told("G21 G90\nG10 L12 P5 R5.\nM98 P9000\n#100=#13005\n"), std::pair(900307, 4U));
}

TEST(FanucStatements, JumpForwardFirst) {
  EXPECT_EQ(flat("N5 G0 X1.\n#1=#1+1\nIF [#1 GT 1] GOTO 9\nGOTO 5\nG0 X2.\nN5 G0 X3.\nN9 M30\n"),
            "N5 G0 X1.\nN5 G0 X3.\nN9 M30\n");
}

TEST(FanucStatements, StopWithTheTextOfAnAlarmAndStopForAMessage) {
  EXPECT_EQ(flat("N7 #3006=1 (TURN THE PART)\nM30\n"), "N7 M00 (TURN THE PART)\nM30\n");
  const ProgramRun ran = to_text("G0 X0\n#3000=7 (NO DEPTH)\nM30\n", fanuc());
  ASSERT_EQ(ran.diagnostics.size(), 1u);
  EXPECT_EQ(ran.diagnostics[0].code, Code::program_alarm);
  EXPECT_EQ(ran.diagnostics[0].detail, "#3000=7 (NO DEPTH)");
}

TEST(FanucCalls, PassArgumentsInBothWays) {
  const std::string macro = "M30\nO9\nG0 X#1 Y#4 Z#7 A#10 B#26\nM99\n";
  EXPECT_EQ(flat("G65 P9 A1. I2. D3. Z4.\n" + macro), "(O0009)\nG0 X1. Y2. Z3. B4.\nM30\n");
  EXPECT_EQ(flat("G65 P9 A1. I2. I3. I4.\n" + macro), "(O0009)\nG0 X1. Y2. Z3. A4.\nM30\n");
  // What comes later counts.
  EXPECT_EQ(flat("G65 P9 A1. I-3. I4. D5.\n" + macro), "(O0009)\nG0 X1. Y-3. Z5.\nM30\n");
}

TEST(FanucCalls, ShareTheVariablesOfTheirCallerOrHaveTheirOwn) {
  EXPECT_EQ(flat("#1=5\nM98 P9\nG0 X#1\nM30\nO9\n#1=#1+1\nM99\n"), "(O0009)\nG0 X6.\nM30\n");
  EXPECT_EQ(flat("#1=5\nG65 P9 A1.\nG0 X#1\nM30\nO9\n#1=#1+1\nG0 Y#1\nM99\n"),
            "(O0009)\nG0 Y2.\nG0 X5.\nM30\n");
}

TEST(FanucCalls, RepeatAsTheirLSaysOrTheDigitsBeforeTheProgram) {
  const std::string rest = "M30\nO12\nG91 X1.\nM99\n";
  const std::string thrice = "(O0012)\nG91 X1.\n(O0012)\nG91 X1.\n(O0012)\nG91 X1.\nM30\n";
  EXPECT_EQ(flat("M98 P12 L3\n" + rest), thrice);
  EXPECT_EQ(flat("M98 P0030012\n" + rest), thrice);
  EXPECT_EQ(flat("M98 P00012\n" + rest), "(O0012)\nG91 X1.\nM30\n");
  EXPECT_EQ(flat("M98 P31001\nM30\nO31001\nG0 X1.\nM99\nO1001\nG0 X2.\nM99\n"),
            "(O31001)\nG0 X1.\nM30\n");
}

TEST(FanucCalls, StandAfterTheOtherWordsOfTheirLine) {
  EXPECT_EQ(flat("N5 G0 X1. M98 P9 (A)\nM30\nO9\nY1. M99\n"), "N5 G0 X1. (A)\n(O0009)\nY1.\nM30\n");
  EXPECT_EQ(flat("N5 M98 P9 (A)\nM30\nO9\nG0 Y1.\nN8 M99 (END)\n"),
            "N5 (O0009) (A)\nG0 Y1.\nN8 (END)\nM30\n");
}

TEST(FanucCalls, OfHaasGoToLinesOfTheSameProgram) {
  EXPECT_EQ(flat("O1\nM97 P100 L2\nG0 X9.\nM30\nN100 G91 G0 X1.\nM99\n%\n"),
            "O1\n(N100)\nN100 G91 G0 X1.\n(N100)\nN100 G91 G0 X1.\nG0 X9.\nM30\n%\n");
}

TEST(FanucCalls, ReturnToANumberOfTheirCallerOrOfThemselves) {
  EXPECT_EQ(flat("M98 P9\nG0 X1.\nN50 G0 X2.\nM30\nO9\nG0 Y1.\nM99 P50\n"),
            "(O0009)\nG0 Y1.\nN50 G0 X2.\nM30\n");
  EXPECT_EQ(flat("M98 P9\nG0 X1.\nM30\nO9\nM99 P60\nG0 Y1.\nN60 G0 Y2.\nM99\n"),
            "(O0009)\nN60 G0 Y2.\nG0 X1.\nM30\n");
  const ProgramRun both = to_text("M98 P9\nN5 G0 X1.\nM30\nO9\nM99 P5\nN5 G0 Y2.\nM99\n", fanuc());
  ASSERT_EQ(both.diagnostics.size(), 1u);
  EXPECT_EQ(both.diagnostics[0].code, Code::jump_target_unknown);
}

TEST(FanucCalls, FindWhatTheSetupGives) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.subprograms = {{"O100.NC", "%\nO100\nG0 X#1\nM99\n%\n"},
                                       {"lib/0200.txt", "G0 Y#1\nM99\n"}};
  EXPECT_EQ(flat_of("#1=4\nM98 P100\nM98 P200\nM30\n", setup),
            "(O0100)\nG0 X4.\n(O0200)\nG0 Y4.\nM30\n");
}

struct Refusal {
  std::string text{};
  Code code{};
  std::uint32_t line = 0;
};

TEST(FanucRefusals, NameTheirLine) {
  const std::vector<Refusal> refusals{
      {"G0 X#500\n", Code::variable_unset, 1},
      {"G0 X[#7]\n", Code::variable_unset, 1},
      {"G0 X1.\n#100=#5042\n", Code::machine_state, 2},
      {"#2001=0\n", Code::machine_state, 1},
      {"#3005=1\n", Code::machine_state, 1},
      {"#0=1\n", Code::value_invalid, 1},
      {"#50=1\n", Code::value_invalid, 1},
      {"#[-1]=1\n", Code::value_invalid, 1},
      {"#1=1/#2\n", Code::division_by_zero, 1},
      {"#1=5 MOD 0.2\n", Code::division_by_zero, 1},
      {"#1=SQRT[-2]\n", Code::value_invalid, 1},
      {"#1=LN[0]\n", Code::value_invalid, 1},
      {"#1=ACOS[1.1]\n", Code::value_invalid, 1},
      {"#1=EXP[1000]\n", Code::value_invalid, 1},
      {"#1=BIN[10]\n", Code::value_invalid, 1},
      {"#1=[1+2\n", Code::expression_invalid, 1},
      {"#1=1+\n", Code::expression_invalid, 1},
      {"#1=5)\n", Code::expression_invalid, 1},
      {"#1=SINE[5]\n", Code::expression_invalid, 1},
      {"#1 5\n", Code::expression_invalid, 1},
      {"#1=3 X5.\n", Code::expression_invalid, 1},
      {"G0 X#1+5\n", Code::expression_invalid, 1},
      {"IF [1 LT 2 LT 3] GOTO 5\nN5\n", Code::expression_invalid, 1},
      {"IF 1 GOTO 5\nN5\n", Code::expression_invalid, 1},
      {"IF [1] THEN G0 X1.\n", Code::nc_unsupported, 1},
      {"WHILE [1] \nEND1\n", Code::expression_invalid, 1},
      {"WHILE [1 LT 0] DO1\nM30\n", Code::block_structure, 1},
      {"G0 X1.\nEND1\n", Code::block_structure, 2},
      {"GOTO 77\n", Code::jump_target_unknown, 1},
      {"M97 P77\n", Code::jump_target_unknown, 1},
      {"M98 P77\n", Code::subprogram_unknown, 1},
      {"M98 L3\n", Code::subprogram_unknown, 1},
      {"M98 P1\nM30\nO1\nM99\nO1\nM99\n", Code::subprogram_unknown, 1},
      {"G65 P77 A1.\n", Code::subprogram_unknown, 1},
      {"G90 G65 P1\nM30\nO1\nM99\n", Code::value_invalid, 1},
      {"M98 P1\nM30\nO1\nG0 X1.\n", Code::block_structure, 4},
      {"M98 P1\nM30\nO1\nM98 P1\nM99\n", Code::calls_too_deep, 4},
      {"/#1=5\n", Code::block_skip_undecided, 1},
      {"/M98 P1\nM30\nO1\nM99\n", Code::block_skip_undecided, 1},
      {"#1=1\nG66 P5\n", Code::subprogram_unknown, 2},
      {"G66 P1\n/X5.\nM30\nO1\nM99\n", Code::block_skip_undecided, 2},
      {"G66 P1\nG66 P2\nM30\nO1\nM99\nO2\nM99\n", Code::nc_unsupported, 2},
      {"G66 P1\nM98 P2\nM30\nO1\nM99\nO2\nG0 X1.\nM99\n", Code::nc_unsupported, 2},
      {"M98 P2\nM30\nO1\nM99\nO2\nG66 P1\nM99\n", Code::nc_unsupported, 7},
      {"#1=1\nM96 P5\n", Code::nc_unsupported, 2},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.text);
    const ProgramRun ran = to_text(refusal.text, fanuc());
    ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report() << ran.text;
    EXPECT_EQ(ran.diagnostics[0].code, refusal.code) << ran.report();
    EXPECT_EQ(ran.diagnostics[0].source.line, refusal.line);
  }
}

TEST(FanucModalCalls, ComeAfterLinesThatMoveAnAxis) {
  const std::string macro = "G67\nM30\nO2\nG1 F100 Z-1.\nM99\n";
  const auto rounds = [&](const std::string& lines) {
    const std::string text = flat("G66 P2\n" + lines + macro);
    std::size_t found = 0;
    for (std::size_t at = text.find("Z-1"); at != std::string::npos; at = text.find("Z-1", at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(rounds("X1.\nA5.\n"), 2U);
  for (const std::string line :
       {"G4 X1.", "G10 L2 P1 X5.", "G52 X0", "G92 X0.", "G68 X0 Y0 R30.", "M8", "F200"})
    EXPECT_EQ(rounds(line + "\n"), 0U) << line;
}

TEST(FanucArguments, WithoutAPointAreRefusedUnderIncrements) {
  const std::string macro = "\nM30\nO2\nG0 X#24\nM99\n";
  ProgramSessionSetup setup = fanuc();
  setup.session.program.whole_numbers = WholeNumbers::increments;
  const ProgramRun whole = to_text("G65 P2 X10" + macro, setup);
  ASSERT_EQ(whole.diagnostics.size(), 1U) << whole.text;
  EXPECT_EQ(whole.diagnostics[0].code, Code::value_invalid);
  EXPECT_FALSE(to_text("G65 P2 X10." + macro, setup).stopped);
  EXPECT_FALSE(to_text("G65 P2 X10" + macro, fanuc()).stopped);
}

const std::string leave = "G40 X0 Y-40.\nG0 Z50.\nM30\n";

std::string holes_on_a_circle(int count, double radius) {
  std::string text = "G21 G90\nG0 Z5.\n";
  for (int hole = 0; hole < count; ++hole) {
    const double angle = 360.0 / count * hole + 15;
    text += "G0 " + word('X', radius * cosine(angle)) + word('Y', radius * sine(angle)) +
            "\nG1 Z-3. F100\nG0 Z5.\n";
  }
  return text + "M30\n";
}

std::string pocket_in_depths(double step, double depth) {
  std::string text = "G21 G90 G0 X10. Y10.\n";
  for (double z = -step; z > -depth - 1e-9; z -= step)
    text += "G1 " + word('Z', z) + " F100\nG41 D1 G1 X20. Y5. F500\nX30.\nY25.\nX0\nY5.\nX20.\n" +
            "G40 X10. Y10.\n";
  return text + "G0 Z50.\nM30\n";
}

std::string ellipse(double a, double b, double step) {
  std::string text = "G90 G0 X40. Y-10.\nG42 D1 G1 " + word('X', a) + " Y-10. F400\n";
  for (double angle = 0; angle < 360 + 1e-9; angle += step)
    text += "G1 " + word('X', a * cosine(angle)) + word('Y', b * sine(angle)) + "\n";
  return text + "G1 " + word('X', a) + "Y10.\nG40 X50. Y10.\nM30\n";
}

std::string polygon_from_below(int corners, double radius) {
  std::string text = "G90 G0 X0 Y-40.\nG41 D1 G1 " + word('X', 0) + word('Y', -radius) + " F300\n";
  for (int corner = 1; corner <= corners; ++corner) {
    const double angle = -90 - 360.0 / corners * corner;
    text += "G1 " + word('X', radius * cosine(angle)) + word('Y', radius * sine(angle)) + "\n";
  }
  return text + leave;
}

std::vector<Twin> twins() {
  std::vector<Twin> all;
  all.push_back({.name = "BoltCircle",
                 .computed =
                     "G21 G90\nG0 Z5.\n#1=8\n#2=30.\n#3=0\nWHILE [#3 LT #1] DO1\n"
                     "#4=360/#1*#3+15\nG0 X[#2*COS[#4]] Y[#2*SIN[#4]]\nG1 Z-3. F100\nG0 Z5.\n"
                     "#3=#3+1\nEND1\nM30\n",
                 .flat = holes_on_a_circle(8, 30)});
  all.push_back({.name = "BoltCircleByMacro",
                 .computed = "G21 G90\nG0 Z5.\nG65 P9100 A15. B7 R22.5\nM30\nO9100\n#30=0\n"
                             "N1 IF [#30 GE #2] GOTO 2\n#31=#1+#30*360/#2\n"
                             "G0 X[#18*COS[#31]] Y[#18*SIN[#31]]\nG1 Z-3. F100\nG0 Z5.\n#30=#30+1\n"
                             "GOTO 1\nN2 M99\n",
                 .flat = holes_on_a_circle(7, 22.5)});
  all.push_back({.name = "PocketInDepths",
                 .computed = "G21 G90 G0 X10. Y10.\n#101=2.5\n#102=-#101\nWHILE[#102GE-10.]DO1\n"
                             "G1 Z#102 F100\nG41 D1 G1 X20. Y5. F500\nX30.\nY25.\nX0\nY5.\nX20.\n"
                             "G40 X10. Y10.\n#102=#102-#101\nEND1\nG0 Z50.\nM30\n",
                 .flat = pocket_in_depths(2.5, 10)});
  all.push_back({.name = "DepthPassesByRepetition",
                 .computed =
                     "G21 G90 G0 X10. Y10.\n#5=0\nM98 P500 L4\nG0 Z50.\nM30\nO500\n#5=#5-2.5\n"
                     "G1 Z#5 F100\nG41 D1 G1 X20. Y5. F500\nX30.\nY25.\nX0\nY5.\nX20.\n"
                     "G40 X10. Y10.\nM99\n",
                 .flat = pocket_in_depths(2.5, 10)});
  all.push_back({.name = "DepthPassesOfOldControls",
                 .computed =
                     "G21 G90 G0 X10. Y10.\n#5=0\nM98 P0040500\nG0 Z50.\nM30\nO500\n"
                     "#5=#5-2.5\nG1 Z#5 F100\nG41 D1 G1 X20. Y5. F500\nX30.\nY25.\nX0\nY5.\n"
                     "X20.\nG40 X10. Y10.\nM99\n",
                 .flat = pocket_in_depths(2.5, 10)});
  all.push_back({.name = "DepthPassesOfHaas",
                 .computed =
                     "G21 G90 G0 X10. Y10.\n#5=0\nM97 P500 L4\nG0 Z50.\nM30\nN500 #5=#5-2.5\n"
                     "G1 Z#5 F100\nG41 D1 G1 X20. Y5. F500\nX30.\nY25.\nX0\nY5.\nX20.\n"
                     "G40 X10. Y10.\nM99\n",
                 .flat = pocket_in_depths(2.5, 10)});
  all.push_back({.name = "EllipseByALoop",
                 .computed =
                     "G90 G0 X40. Y-10.\n#1=30.\n#2=18.\n#3=0\nG42 D1 G1 X#1 Y-10. F400\n"
                     "WHILE [#3 LE 360] DO2\nG1 X[#1*COS[#3]] Y[#2*SIN[#3]]\n#3=#3+5\nEND2\n"
                     "G1 X#1 Y10.\nG40 X50. Y10.\nM30\n",
                 .flat = ellipse(30, 18, 5)});
  all.push_back({.name = "EllipseByJumps",
                 .computed =
                     "G90 G0 X40. Y-10.\n#1=25.\n#2=20.\nG42 D1 G1 X#1 Y-10. F400\n#3=0\n"
                     "N10 G1 X[#1*COS[#3]] Y[#2*SIN[#3]]\n#3=#3+7.5\nIF [#3 LE 360] GOTO 10\n"
                     "G1 X#1 Y10.\nG40 X50. Y10.\nM30\n",
                 .flat = ellipse(25, 20, 7.5)});
  all.push_back({.name = "SquaresByMacro",
                 .computed = "G90 G0 X0 Y-40.\nG65 P8000 S40. Z-1.\nG65 P8000 S30. Z-2.\n"
                             "G65 P8000 S20. Z-3.\nG0 Z50.\nM30\n:8000\n#1=#19/2\nG0 Z#26\n"
                             "G41 D1 G1 X-#1 Y-#1 F500\nY#1\nX#1\nY-#1\nX-#1\nG40 X0 Y-40.\nM99\n",
                 .flat = "G90 G0 X0 Y-40.\n" + square(40, -1, "G41 D1") + square(30, -2, "G41 D1") +
                         square(20, -3, "G41 D1") + "G0 Z50.\nM30\n"});
  all.push_back({.name = "NestedCalls",
                 .computed =
                     "G90 G0 X0 Y-40.\n#100=0\nM98 P1\nG0 Z50.\nM30\nO1\nM98 P2 L2\n"
                     "#100=#100+10\nM98 P2\nM99\nO2\nG65 P3 S[40-#100] Z-[#100+1]\nM99\nO3\n"
                     "#1=#19/2\nG0 Z#26\nG41 D1 G1 X-#1 Y-#1 F500\nY#1\nX#1\nY-#1\nX-#1\n"
                     "G40 X0 Y-40.\nM99\n",
                 .flat = "G90 G0 X0 Y-40.\n" + square(40, -1, "G41 D1") + square(40, -1, "G41 D1") +
                         square(30, -11, "G41 D1") + "G0 Z50.\nM30\n"});
  all.push_back({.name = "NestedLoops",
                 .computed = "G21 G90\n#1=0\nWHILE [#1 LT 3] DO1\n#2=0\n"
                             "WHILE [#2 LT 2] DO2\nG0 X[#1*10] Y[#2*5]\n"
                             "#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n",
                 .flat = "G21 G90\nG0 X0 Y0\nG0 X0 Y5.\nG0 X10. Y0\nG0 X10. Y5.\nG0 X20. Y0\n"
                         "G0 X20. Y5.\nM30\n"});
  all.push_back({.name = "HexagonByAngles",
                 .computed = "G90 G0 X0 Y-40.\n#1=6\n#2=24.\n#3=1\nG41 D1 G1 X0 Y-#2 F300\n"
                             "WHILE [#3 LE #1] DO1\nG1 X[#2*COS[-90-#3*360/#1]] "
                             "Y[#2*SIN[-90-#3*360/#1]]\n#3=#3+1\nEND1\n" +
                             leave,
                 .flat = polygon_from_below(6, 24)});
  all.push_back({.name = "RoundPocketWithArcs",
                 .computed =
                     "G90 G0 X0 Y0\n#1=15.\nG41 D1 G1 X#1 Y0 F300\nG3 I-#1\nG40 G1 X0 Y0\n"
                     "#1=#1+5\nG41 D1 G1 X#1 Y0\nG3 X-#1 R#1\nG3 X#1 R#1\nG40 G1 X0 Y0\nM30\n",
                 .flat = "G90 G0 X0 Y0\nG41 D1 G1 X15. Y0 F300\nG3 I-15.\nG40 G1 X0 Y0\n"
                         "G41 D1 G1 X20. Y0\nG3 X-20. R20.\nG3 X20. R20.\nG40 G1 X0 Y0\nM30\n"});
  all.push_back({.name = "ChoiceByConditions",
                 .computed =
                     "G90 G0 X0 Y-40.\n#1=2\nIF [#1 EQ 1] THEN #2=10.\n"
                     "IF [[#1 EQ 2] AND [#2 EQ #0]] THEN #2=30.\nIF [#2 GT 20] GOTO 7\n#2=#2/2\n"
                     "N7 #3=#2/2\nG0 Z-1.\nG41 D1 G1 X-#3 Y-#3 F500\nY#3\nX#3\nY-#3\nX-#3\n"
                     "G40 X0 Y-40.\nM30\n",
                 .flat = "G90 G0 X0 Y-40.\n" + square(30, -1, "G41 D1") + "M30\n"});
  all.push_back(
      {.name = "InchesAndTools",
       .computed = "G20 G90 G0 X0 Y-2.\n#1=1\n#2=#1/8\nT#1 M6\nG41 D#1 G1 X-[4*#2] Y-[4*#2] "
                   "F20.\nY[4*#2]\nX[4*#2]\nY-[4*#2]\nX-[4*#2]\nG40 X0 Y-2.\nM30\n",
       .flat = "G20 G90 G0 X0 Y-2.\nT1 M6\nG41 D1 G1 X-.5 Y-.5 F20.\nY.5\nX.5\nY-.5\nX-.5\n"
               "G40 X0 Y-2.\nM30\n"});
  all.push_back(
      {.name = "MirroredByAVariable",
       .computed = "G90 G0 X0 Y-40.\n#1=1\nM98 P5\n#1=-1\nM98 P5\nM30\nO5\n"
                   "G[41.5-#1/2] D1 G1 X[10*#1] Y-30. F200\nX[10*#1] Y0\nX[25*#1]\nY-30.\n"
                   "G40 X[40*#1] Y-40.\nG0 X0\nM99\n",
       .flat = "G90 G0 X0 Y-40.\nG41 D1 G1 X10. Y-30. F200\nX10. Y0\nX25.\nY-30.\n"
               "G40 X40. Y-40.\nG0 X0\nG42 D1 G1 X-10. Y-30. F200\nX-10. Y0\nX-25.\nY-30.\n"
               "G40 X-40. Y-40.\nG0 X0\nM30\n"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Fanuc, Twins, ::testing::ValuesIn(with_setup(twins(), DialectName::fanuc)),
                         name_of_twin);

}  // namespace
}  // namespace trc::support::fanuc_computing
