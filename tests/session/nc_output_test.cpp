// What becomes of single lines: which come out as they are, which are written anew and how.

#include <gtest/gtest.h>

#include "tests/support/program_run.h"

namespace trc::support {
namespace {

std::string output(std::string_view program, int decimals = 4) {
  const ProgramRun run = to_text(program, with_decimals(decimals));
  EXPECT_FALSE(run.stopped) << run.codes();
  return run.text;
}

TEST(UntouchedLines, ComeOutByteForByte) {
  const std::string program =
      "\xEF\xBB\xBF%part 7\r\n"
      "\r\n"
      "  n10  g0 x0.50 y-.5   z+1 ( rapid \xC3\xBC )\r\n"
      "N20 G1 X 12.3450 F1e\n"
      "\t(only a remark)\n";
  // E is no exponent: the line above is refused; here is the program that is not.
  const std::string accepted =
      "\xEF\xBB\xBF%part 7\r\n"
      "\r\n"
      "  n10  g0 x0.50 y-.5   z+1 ( rapid \xC3\xBC )\r\n"
      "N20 G1 X 12.345678901 F100\n"
      "\t(only a remark)\n"
      "X20;to the end\r"
      "N30 G02 X30 Y0 I5 J.5 M8\n"
      "N40 G01 X40 \\\n"
      "    Y40\n"
      "G91 X1 Y1\n"
      "M30\n"
      "what follows the end (also G41 here) stays as it is\n"
      "\n"
      "even without a line end";
  EXPECT_TRUE(to_text(program).stopped);
  EXPECT_EQ(output(accepted), accepted);
}

TEST(UntouchedLines, RepeatedPositionsStay) {
  const std::string program = "G0 X10 Y10\nG1 X10 F100\nX10 Y10 M8\nG91 X0\nG90\nZ0\nX20\n";
  EXPECT_EQ(output(program), program);
}

TEST(UntouchedLines, FeedPerRevolutionStays) {
  const std::string program = "G95 F0.2\nG1 X10\nG94\nX20\nF300 X30\nX40\n";
  EXPECT_EQ(output(program), program);
}

TEST(CompensationWords, GoWithTheLineWhenTheyAreAlone) {
  EXPECT_EQ(output("G0 X0 Y0\n"
                   "N10 G139 G25\n"
                   "N20 #TRC[STRETCH_FACTOR=2]\n"
                   "N30 V.G.WZ_AKT.R=5\n"
                   "N40 G10 G140\n"
                   "G1 X5 F100\n"),
            "G0 X0 Y0\nG1 X5 F100\n");
}

TEST(CompensationWords, LeaveTechnologyModesAndComments) {
  EXPECT_EQ(output("G0 X0 Y0\n"
                   "N10 G26 M8 (cooling)\n"
                   "N20 G139 ; mode\n"
                   "N30 G90 G25\n"
                   "N40 G01 G10\n"
                   "N50 G140 F500\n"
                   "X5\n"),
            "G0 X0 Y0\n"
            "N10 M8 (cooling)\n"
            "N20 ; mode\n"
            "N30 G90\n"
            "N40 G01\n"
            "N50 F500\n"
            "X5\n");
}

TEST(CompensationWords, ToolWordsStay) {
  ProgramSessionSetup setup;
  setup.session.program.tools[3] = 5;
  const ProgramRun run = to_text("G0 X0 Y0\nN10 T3 D3 M6\nG41 G1 X10 F100\nX50\nG40 Y-20\n", setup);
  EXPECT_EQ(run.text, "G0 X0 Y0\nN10 T3 D3 M6\nG01 X10 Y5 F100\nG01 X55 Y5\nG01 X50 Y-20\n");
}

TEST(CompensatedLines, KeepTheirOtherWordsInOrder) {
  EXPECT_EQ(output("G0 X0 Y0 V.G.WZ_AKT.R=5\n"
                   "n7 (first) g41 S500 G1 M3 x10 F100 H12 (last) ; end\r\n"
                   "X50\nG40 Y-20\n"),
            "G00 X0 Y0\n"
            "n7 G01 X10 Y5 (first) S500 M3 F100 H12 (last) ; end\r\n"
            "G01 X55 Y5\n"
            "G01 X50 Y-20\n");
}

TEST(CompensatedLines, BlockOverSeveralLinesBecomesOne) {
  EXPECT_EQ(
      output("G0 X0 Y0 V.G.WZ_AKT.R=5\nG41 G1 X10 F100\nN20 X50 \\\n  M8 \\\n (c)\nG40 Y-20\n"),
      "G00 X0 Y0\nG01 X10 Y5 F100\nN20 G01 X55 Y5 M8 (c)\nG01 X50 Y-20\n");
}

TEST(CompensatedLines, BlockOverSeveralLinesKeepsItsFirstNumber) {
  EXPECT_EQ(output("G0 X0 Y0\nV.G.WZ_AKT.R=5\nG41 G1 X10 F100\nN20 X50 \\\nN21 M8\nG40 Y-20\n"),
            "G0 X0 Y0\nG01 X10 Y5 F100\nN20 G01 X55 Y5 M8\nG01 X50 Y-20\n");
}

TEST(InsertedLines, HaveNoNumberAndTheLineEndOfTheLineBefore) {
  EXPECT_EQ(output("G0 X0 Y0\r\nG26 V.G.WZ_AKT.R=5\r\n"
                   "N10 G41 G1 X10 F100\r\nN20 X50\r\nN30 Y-50\r\nN40 G40 X20\n"),
            "G0 X0 Y0\r\n"
            "N10 G01 X10 Y5 F100\r\n"
            "N20 G01 X50 Y5\r\n"
            "G02 X55 Y0 I0 J-5\r\n"
            "N30 G01 X55 Y-50\r\n"
            "G02 X50 Y-55 I-5 J0\r\n"
            "N40 G01 X20 Y-50\n");
}

TEST(InsertedLines, StandAfterALastLineWithoutLineEnd) {
  EXPECT_EQ(output("G0 X0 Y0\nG237 V.G.WZ_AKT.R=5\nG41\nN10 G1 X50 F100\nN20 G40\nN30 G0 X80"),
            "G0 X0 Y0\nN10 G01 X0 Y5 F100\nG01 X50 Y5\nG01 X50 Y0\nN30 G0 X80");
  const ProgramRun run = to_text("G0 X0 Y0\nG237 V.G.WZ_AKT.R=5\nG41\nN10 G1 X50 F100");
  EXPECT_EQ(run.text, "G0 X0 Y0\nN10 G01 X0 Y5 F100\nG01 X50 Y5\n");
}

TEST(PassiveBlocks, StayAfterTheirBlockAndBeforeInsertedOnes) {
  EXPECT_EQ(output("G0 X0 Y0 Z5\nG26 V.G.WZ_AKT.R=5\n"
                   "N10 G41 G1 X10 F100\nN20 X50\n"
                   "N21 M8\nN22 G04 X0.5\n(remark)\nN23 Z-3\n"
                   "N30 Y-50\nN40 G40 X20\nN50 M30\n"),
            "G0 X0 Y0 Z5\n"
            "N10 G01 X10 Y5 F100\n"
            "N20 G01 X50 Y5\n"
            "N21 M8\n"
            "N22 G04 X0.5\n"
            "(remark)\n"
            "N23 Z-3\n"
            "G02 X55 Y0 I0 J-5\n"
            "N30 G01 X55 Y-50\n"
            "G02 X50 Y-55 I-5 J0\n"
            "N40 G01 X20 Y-50\n"
            "N50 M30\n");
}

TEST(PassiveBlocks, DoNotMoveToTheProgrammedPoint) {
  // X50 is where the program is, not where the tool is.
  EXPECT_EQ(output("G0 X0 Y0 Z5\nG138 V.G.WZ_AKT.R=5\n"
                   "G41 G1 X10 Y0 F100\nX50 Y20\nN20 X50 Y20 Z-3\nN21 X50 M9\nX50 Y60\nG40 X0\n"),
            "G0 X0 Y0 Z5\n"
            "G01 X7.7639 Y4.4721 F100\n"
            "G01 X45 Y23.0902\n"
            "N20 G01 Z-3\n"
            "N21 M9\n"
            "G01 X45 Y60\n"
            "G01 X0 Y60\n");
}

TEST(PassiveBlocks, ProgramEndIsAfterTheRetract) {
  EXPECT_EQ(output("G0 X0 Y0\nG237 V.G.WZ_AKT.R=5\nG41\nG1 X50 F100\nG40\nN90 M9 M30\n"),
            "G0 X0 Y0\nG01 X0 Y5 F100\nG01 X50 Y5\nG01 X50 Y0\nN90 M9 M30\n");
}

TEST(PassiveBlocks, AStopStaysAfterTheMotionOfItsLine) {
  EXPECT_EQ(output("N10 G0 X0 Y0\n"
                   "N20 V.G.WZ_AKT.R=10\n"
                   "N30 G41 G01 X30 Y0 F1000\n"
                   "N40 X60 M8 M0\n"
                   "N50 Y40\n"
                   "N60 G40 X100 M30\n"),
            "N10 G0 X0 Y0\n"
            "N30 G01 X30 Y10 F1000\n"
            "N40 G01 X50 Y10 M8\n"
            "M0\n"
            "N50 G01 X50 Y50\n"
            "N60 G01 X100 Y40\n"
            "M30\n");
}

TEST(PassiveBlocks, AStopOfALineThatIsCopiedComesOnce) {
  const std::string program = "G0 X0 Y0\nG01 X5 F100 M0\nM8 M1\nX6 M30\n";
  EXPECT_EQ(output(program), program);
}

TEST(MotionFunction, IsNamedWhenTheLineBeforeHasAnother) {
  // The retract of G05 is an arc; the line after it takes G01 for granted.
  const std::string text = output(
      "G0 X0 Y0\nG139 V.G.WZ_AKT.R=5\nG41 G1 X20 Y0 F100\nX60\nN40 G05 G40 X90 Y40\nN50 "
      "X120\nM30\n");
  EXPECT_NE(text.find("N40 G03 X90 Y40 I"), std::string::npos) << text;
  EXPECT_NE(text.find("N50 G01 X120"), std::string::npos) << text;
}

TEST(Feed, IsWrittenWhereItDiffersAndRestored) {
  EXPECT_EQ(output("G0 X0 Y0 V.G.WZ_AKT.R=5 G11\n"
                   "N10 G41 G1 Y20 X0 F600\n"
                   "N20 X20\nN30 G3 X40 Y40 J20\nN40 G1 Y80\nN50 G40 X0\n"),
            "G00 X0 Y0\n"
            "N10 G01 X-5 Y25 F600\n"
            "N20 G01 X20 Y25\n"
            "N30 G03 X35 Y40 I0 J15 F450\n"
            "N40 G01 X35 Y80 F600\n"
            "N50 G01 X0 Y80\n");
}

TEST(Feed, OfTheLineIsReplacedInItsPlace) {
  EXPECT_EQ(output("G0 X0 Y0 V.G.WZ_AKT.R=5 G11\n"
                   "G41 G1 Y20 X0 F600\nX20\nN30 G3 X40 Y40 J20 S5 F1200 M8\nN40 G1 Y80\nG40 X0\n"),
            "G00 X0 Y0\n"
            "G01 X-5 Y25 F600\n"
            "G01 X20 Y25\n"
            "N30 G03 X35 Y40 I0 J15 S5 F900 M8\n"
            "N40 G01 X35 Y80 F1200\n"
            "G01 X0 Y80\n");
}

TEST(Increments, CountFromTheRoundedPosition) {
  // Each step is 2/3 along the offset line; 30 of them must not drift.
  std::string program = "G0 X0 Y0\nV.G.WZ_AKT.R=1\nG91\nG41 G1 X1 Y1 F100\n";
  for (int i = 0; i < 30; ++i) program += "X1 Y" + std::string(i % 2 == 0 ? "1\n" : "2\n");
  program += "G40 X5\nG90\nM30\n";
  const ProgramRun read = to_blocks(output(program, 2));
  const ProgramRun path = to_blocks(program);
  const Point at = end_of(read.blocks[read.blocks.size() - 3].path);
  const Point meant = end_of(path.blocks[path.blocks.size() - 3].path);
  EXPECT_LE((at - meant).cwiseAbs().maxCoeff(), 0.005 + 1e-9);
}

TEST(Units, InchHasOneDecimalMore) {
  EXPECT_EQ(
      output("G70\nG0 X0 Y0\nV.G.WZ_AKT.R=0.1\nG41 G1 X1 Y0 F10\nX2 Y1\nG40 X3 A30\nG71\nM30\n"),
      "G70\nG0 X0 Y0\nG01 X0.92929 Y0.07071 F10\n"
      "G01 X1.95858 Y1.1\nG01 X3 Y1 A30\nG71\nM30\n");
}

TEST(Planes, CentreLettersFollowTheAxes) {
  EXPECT_EQ(output("G18 G26\nG0 X0 Z0\nV.G.WZ_AKT.R=5\n"
                   "G41 G1 Z10 F100\nZ50\nX-50\nG40 Z20\n"),
            "G18\nG0 X0 Z0\n"
            "G01 X5 Z10 F100\nG01 X5 Z50\nG02 X0 Z55 I-5 K0\nG01 X-50 Z55\n"
            "G02 X-55 Z50 I0 K-5\nG01 X-50 Z20\n");
  EXPECT_EQ(output("G19 G26 G161\nG0 Y0 Z0\nV.G.WZ_AKT.R=5\n"
                   "G41 G1 Y10 F100\nY50\nZ-50\nG40 Y20\n"),
            "G19 G161\nG0 Y0 Z0\n"
            "G01 Y10 Z5 F100\nG01 Y50 Z5\nG02 Y55 Z0 J50 K0\nG01 Y55 Z-50\n"
            "G02 Y50 Z-55 J50 K-50\nG01 Y20 Z-50\n");
}

TEST(Circles, RadiusWordBecomesACentre) {
  EXPECT_EQ(output("G0 X0 Y0\nV.G.WZ_AKT.R=2\nG41 G1 X10 F100\nG3 X30 Y20 R20\nG1 Y50\nG40 X0\n"),
            "G0 X0 Y0\nG01 X10 Y2 F100\nG03 X28 Y20 I0 J18\nG01 X28 Y50\nG01 X0 Y50\n");
}

TEST(Circles, FullCircleStaysOne) {
  EXPECT_EQ(output("G0 X0 Y0\nG138 V.G.WZ_AKT.R=2\nG41 G1 X10 F100\nG3 I0 J20\nX10 I0 J20 Z-5\n"
                   "G40 G1 X50\n"),
            "G0 X0 Y0\nG01 X10 Y2 F100\nG03 X10 Y2 I0 J18\nG03 X10 Y2 Z-5 I0 J18\nG01 X50 Y0\n");
}

TEST(Circles, FullCircleFromARoundedStartIsOnlyItsCentre) {
  // X10.00004 cannot be written with four decimals: an end there would be an arc of 0.04 um.
  const std::string program = "G0 X10.00004 Y0\nG138\nN20 G25 G3 I0 J20 F100\nG1 X50\n";
  EXPECT_EQ(output(program), "G0 X10.00004 Y0\nN20 G03 I0 J20 F100\nG1 X50\n");
}

TEST(Circles, HelixAndTrackingAxesGoWithTheirBlock) {
  EXPECT_EQ(output("G0 X0 Y0 Z0\nG26 V.G.WZ_AKT.R=5\nG41 G1 X10 F100\n"
                   "N20 X50 Z-1 A90\nN30 Y-50 Z-2\nN40 G40 X20 Z0 A0\n"),
            "G0 X0 Y0 Z0\n"
            "G01 X10 Y5 F100\n"
            "N20 G01 X50 Y5 Z-1 A90\n"
            "G02 X55 Y0 I0 J-5\n"
            "N30 G01 X55 Y-50 Z-2\n"
            "G02 X50 Y-55 I-5 J0\n"
            "N40 G01 X20 Y-50 Z0 A0\n");
}

TEST(ShortBlocks, VanishWhenTheyHaveNoLengthAfterRounding) {
  const std::string text = output(
      "G0 X0 Y0\nV.G.WZ_AKT.R=1\nG41 G1 X10 F100\nN20 X10.001\nN30 X10.002 M8\nX50\nG40 Y-20\n", 1);
  EXPECT_EQ(text, "G0 X0 Y0\nG01 X10 Y1 F100\nN30 M8\nG01 X51 Y1\nG01 X50 Y-20\n");
}

TEST(Refusals, WhatWasCertainIsWrittenAndNothingAfter) {  // D-144
  const std::string program = "N10 G0 X0 Y0\nN20 G1 X10 F100\nN30 G1 X20\nN40 QQ\nN50 X30\n";
  for (const std::size_t cut : {0U, 1U, 2U, 5U, 11U}) {
    const ProgramRun run = to_text(program, {}, cut);
    EXPECT_TRUE(run.stopped);
    EXPECT_EQ(run.text, "N10 G0 X0 Y0\nN20 G1 X10 F100\nN30 G1 X20\n") << cut;
    ASSERT_EQ(run.diagnostics.size(), 1U);
    EXPECT_EQ(run.diagnostics[0].source.line, 4U);
  }
}

TEST(Refusals, BinaryAfterTheProgramEnd) {
  const std::string program = "G0 X0\nM30\ntext\nmore \xFF\nlast\n";
  for (const std::size_t cut : {0U, 1U, 4U, 9U}) {
    const ProgramRun run = to_text(program, {}, cut);
    EXPECT_TRUE(run.stopped);
    EXPECT_EQ(run.text, "G0 X0\nM30\ntext\n") << cut;
  }
}

TEST(Refusals, OrderOfDiagnosticsIsThatOfTheProgram) {
  // The warning of line 3 comes from reading, the error of line 6 from compensating,
  // the error of line 9 from reading again.
  const std::string program =
      "G0 X0 Y0\nV.G.WZ_AKT.R=10\n#TRC[STRETCH_FACTOR=20]\nG41 G1 X0 Y20 F100\nX50\nX55 Y25\n"
      "Y70\nG40 X0\nQQ\n";
  for (const std::size_t cut : {0U, 1U, 3U, 64U})
    EXPECT_EQ(to_text(program, {}, cut).codes(), "22007 at line 3; 90019 at line 6") << cut;
}

TEST(Refusals, DecimalsOutOfRange) {
  for (const int decimals : {-1, 9}) {
    const ProgramRun run = to_text("G0 X1\n", with_decimals(decimals));
    EXPECT_TRUE(run.stopped);
    EXPECT_EQ(run.text, "");
    ASSERT_EQ(run.diagnostics.size(), 1U);
    EXPECT_EQ(run.diagnostics[0].code, Code::field_invalid);
  }
}

ProgramSessionSetup of_dialect(DialectName dialect, double radius) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = dialect;
  setup.session.program.mode.tool_radius = radius;
  setup.session.program.mode.selection = Selection::direct;
  return setup;
}

// The third of a millimetre shows how many decimals a number has.
constexpr double third = 1.0 / 3;

TEST(Decimals, AreThoseOfTheProgramFromItsFirstLineThatHasMore) {
  const std::string program =
      "G0 X-10.1234567 Y-5\nG41 G1 X0 Y0 F100\nY10.12345\nX10.1\nY0.1234567\nG40 X20\nX30.3\n";
  const std::string wanted =
      "G0 X-10.1234567 Y-5\nG01 X-0.3333 Y0 F100\nG01 X-0.33333 Y10.45678\n"
      "G01 X10.43333 Y10.45678\nG01 X10.4333333 Y0.1234567\nG01 X20 Y0.1234567\nX30.3\n";
  for (const std::size_t piece : {0U, 1U, 7U, 40U}) {
    const ProgramRun run = to_text(program, of_dialect(DialectName::isg, third), piece);
    EXPECT_FALSE(run.stopped) << run.report();
    EXPECT_EQ(run.text, wanted) << piece;
  }
}

TEST(Decimals, AreThoseOfTheSettingWhereItIsGiven) {
  ProgramSessionSetup setup = of_dialect(DialectName::isg, third);
  setup.session.program.decimals = 3;
  EXPECT_EQ(to_text("G0 X-10 Y0\nG41 G1 X0.123456 F100\nY10\nG40 X-20\n", setup).text,
            "G0 X-10 Y0\nG01 X-0.21 Y0 F100\nG01 X-0.21 Y10\nG01 X-20 Y10\n");
}

TEST(Decimals, OfAnInchAreOneMore) {
  ProgramSessionSetup setup = of_dialect(DialectName::linuxcnc, third * mm_per_inch);
  const std::string line = "G20 G0 X-10 Y0\nG41 G1 X0";
  EXPECT_NE(to_text(line + " F10\nY1.12345\nG40 X-3\n", setup).text.find("X-0.33333 Y1.12345\n"),
            std::string::npos);
  EXPECT_NE(to_text(line + " F10\nY1.123456\nG40 X-3\n", setup).text.find("X-0.333333 Y1.123456\n"),
            std::string::npos);
}

// A computed value has eight, which nobody wrote.
TEST(Decimals, OfComputedValuesDoNotCount) {
  const ProgramRun run = to_text("#1=20\nG0 X-10. Y0.\nG41 G1 X0. F100.\nY[#1/3]\nG40 X-20.\n",
                                 of_dialect(DialectName::fanuc, third));
  EXPECT_FALSE(run.stopped) << run.report();
  EXPECT_EQ(run.text,
            "G0 X-10. Y0.\nG01 X-0.3333 Y0. F100.\nG01 X-0.3333 Y6.6667\nG01 X-20. Y6.6667\n");
}

TEST(LongLines, ThatTheControlDoesNotTakeAreRefused) {
  const std::string comment = " (" + std::string(240, 'x') + ")";
  const std::string before = "G0 X-10 Y0" + comment + comment + "\nG41 G1 X0 F100\n";
  const std::string line = "Y10" + comment;
  for (const std::size_t piece : {0U, 1U, 50U}) {
    const ProgramRun run = to_text(before + line + "\nG40 X-20\nM2\n",
                                   of_dialect(DialectName::linuxcnc, third), piece);
    EXPECT_EQ(run.codes(), "900235 at line 3") << piece;
    EXPECT_EQ(run.text, before.substr(0, before.find("G41")) + "G01 X-0.3333 Y0 F100\n") << piece;
    ASSERT_EQ(run.diagnostics.back().values.size(), 2U);
    EXPECT_EQ(run.diagnostics.back().values[0].value, 259);  // G01 X-0.3333 Y10 and the comment
    EXPECT_EQ(run.diagnostics.back().values[1].value, 255);
  }
  const ProgramRun fits =
      to_text(before + line + "\nG40 X-20\nM30\n", of_dialect(DialectName::sinumerik, third));
  EXPECT_FALSE(fits.stopped) << fits.report();
}

TEST(LongNumbers, ThatTheControlDoesNotTakeAreRefused) {
  const std::string program = "G0 X11990. Y0.\nG41 G1 X12000. F100.\nY10.\nG40 X11980.\n";
  EXPECT_EQ(to_text(program, of_dialect(DialectName::fanuc, third)).codes(), "900235 at line 2");
  ProgramSessionSetup coarse = of_dialect(DialectName::fanuc, third);
  coarse.session.program.decimals = 3;
  EXPECT_FALSE(to_text(program, coarse).stopped);
  EXPECT_FALSE(to_text(program, of_dialect(DialectName::linuxcnc, third)).stopped);
  // The control has read such a number before.
  EXPECT_FALSE(to_text("G0 X11990. Y0.\nG41 G1 X12000.1234 F100.\nY10.\nG40 X11980.\n",
                       of_dialect(DialectName::fanuc, third))
                   .stopped);
}

TEST(Decimals, OfHeidenhainAreFiveAtMost) {
  const ProgramRun run = to_text(
      "BEGIN PGM A MM\nL X-10 Y+0 FMAX\nL X+0 RL F100\nL Y+10.1234567\nL X-20 R0\nEND PGM A MM\n",
      of_dialect(DialectName::heidenhain, third));
  EXPECT_NE(run.text.find("L X-0.33333 Y+10.12346"), std::string::npos) << run.text;
}

// A feed that is computed has fewer decimals before it has too many digits.
TEST(LongNumbers, AFeedIsRounded) {
  ProgramSessionSetup setup = of_dialect(DialectName::fanuc, third);
  setup.session.program.mode.feed_adaptation = FeedAdaptation::on;
  setup.session.program.mode.transition = Transition::circular;
  const ProgramRun run = to_text(
      "G0 X-10. Y0.\nG41 G1 X0. F12345.\nY10.\nG3 X-7. Y17. I-7. J0.\nG40 G1 X-20.\n", setup);
  EXPECT_FALSE(run.stopped) << run.report();
  EXPECT_NE(run.text.find("F11757.143\n"), std::string::npos) << run.text;
}

TEST(Memory, LinesThatGiveNoBlockDoNotPileUp) {
  ProgramSession session({});
  std::string written;
  Answers out([&](const Answer& part) {
    written += part.text;
    return true;
  });
  std::string program = "G0 X0\n";
  ASSERT_TRUE(session.feed(program, out));
  for (int i = 0; i < 10'000; ++i) {
    const std::string remark = "(" + std::to_string(i) + ")\n";
    program += remark;
    ASSERT_TRUE(session.feed(remark, out));
    ASSERT_LT(program.size() - written.size(), 4096U);
  }
  ASSERT_TRUE(session.finish(out));
  EXPECT_EQ(written, program);
}

TEST(Memory, TextBetweenTwoBlocksOfAContourIsLimited) {
  ProgramSession session({});
  Answers out;
  ASSERT_TRUE(session.feed("V.G.WZ_AKT.R=1\nG41 G1 X10 F100\nX20\n", out));
  const std::string remark = "(" + std::string(60'000, 'x') + ")\n";
  bool goes_on = true;
  for (int i = 0; goes_on && i < 2'000; ++i) goes_on = session.feed(remark, out);
  EXPECT_FALSE(goes_on);
  const std::vector<Diagnostic> told = out.take().diagnostics;
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].code, Code::too_many_passive_blocks);
}

}  // namespace
}  // namespace trc::support
