#include <gtest/gtest.h>

#include <string>

#include "tests/programs/computing.h"

// Klartext outside of contours: jumps, lines along one axis, cycles that move as soon as they are
// defined.

namespace trc::support {
namespace {

int code_of(const std::string& text) {
  return refusal_of("BEGIN PGM A MM\nTOOL CALL 5 Z S5000\n" + text + "END PGM A MM\n",
                    computing_setup(DialectName::heidenhain, 5))
      .first;
}

std::string text_of(const std::string& text) {
  return to_text(text, computing_setup(DialectName::heidenhain, 5)).text;
}

const std::string contour = "L X+0 Y-10 RL F200\nL Y+40\nL X-20 R0\n";
// It counts from where the tool stands.
const std::string step = "L IX+1 IY+1 R0 FMAX\n";
const std::string loop =
    "FN 0: Q1 = +0\nLBL 1\nL X+Q1 Y+0 R0 FMAX M3\nFN 1: Q1 = +Q1 + +10\n"
    "FN 12: IF +Q1 LT +50 GOTO LBL 1\nL Z+50 R0 FMAX\nM30\n";

// After a tool change the height is unknown until a line programs it.
TEST(KlartextOff, StepsFromAHeightThatIsNotKnown) {
  EXPECT_EQ(code_of("L X-20 Y-10 R0 FMAX\nL IZ-3 R0 F100\n" + contour), 0);
  EXPECT_EQ(code_of("L X-20 Y-10 R0 FMAX\nL IX-3 IZ-3 R0 F100\n" + contour), 900106);
}

TEST(KlartextOff, JumpsComeOutAsTheyStand) {
  const std::string program = "BEGIN PGM A MM\n" + loop + "END PGM A MM\n";
  EXPECT_EQ(text_of(program), program);
}

// A contour before a jump may run again; one after it may begin at an unknown point (D-114).
TEST(KlartextOff, NoContourStandsBesideAJump) {
  const std::string start = "L X-20 Y-20 R0 FMAX\n";
  EXPECT_EQ(code_of(start + contour), 0);
  EXPECT_EQ(code_of(start + contour + loop), 900003);
  EXPECT_EQ(code_of("FN 9: IF +Q1 EQU +0 GOTO LBL 1\nLBL 1\n" + start + contour), 900003);
  EXPECT_EQ(code_of("FN 9: IF +Q1 EQU +0 GOTO LBL 1\nL X+0 Y+0\nCC X+5 Y+0\nLBL 1\nC X+10 Y+0 "
                    "DR+\n"),
            900106);
}

TEST(KlartextOff, LinesAlongOneAxis) {  // D-115
  EXPECT_EQ(code_of("X-20 R0 FMAX\nY-20 R0 FMAX M3\nZ-5 R0 F100\n" + contour), 0);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nZ-5\nIX+1\nC+90 R0 FMAX\n" + contour), 0);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nX+5 R+\n" + contour), 900003);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nX+5 M91\n" + step), 900106);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\n/ X+5\n" + step), 900106);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nX+Q9\n" + step), 900106);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nL X+0 Y-10 RL F200\nZ-5\nL Y+40\nL X-20 R0\n"), 900003);
}

// The values that are given hold at the start, as those that the program gives.
TEST(KlartextOff, ParametersAreKnownFromTheSetup) {
  ProgramSessionSetup setup = computing_setup(DialectName::heidenhain, 5);
  const std::string text =
      "BEGIN PGM A MM\nTOOL CALL 5 Z S5000\nL X-20 Y-20 R0 FMAX\n"
      "L X+0 Y-10 RL F200\nL Y+Q10\nCHF Q4\nL X+40\nL X+60 R0\nEND PGM A MM\n";
  const ProgramRun refused = to_text(text, setup);
  ASSERT_EQ(refused.diagnostics.size(), 2U) << refused.report();
  EXPECT_EQ(refused.diagnostics[0].detail, "Y+Q10, a variable, while TRC is active");
  EXPECT_EQ(refused.diagnostics[1].detail, "CHF Q4, a variable, while TRC is active");
  setup.session.program.variables = {{"q10", 40}, {"Q4", 5}};
  const ProgramRun known = to_blocks(text, setup);
  ASSERT_FALSE(known.stopped) << known.report();
  std::string numbers = text;
  numbers.replace(numbers.find("+Q10"), 4, "+40").replace(numbers.find(" Q4"), 3, " 5");
  EXPECT_EQ(known.blocks.size(), to_blocks(numbers, setup).blocks.size());
}

TEST(KlartextOff, TheTipOfTheToolIsLedAlongNoSide) {
  const std::string tcpm = "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n";
  EXPECT_EQ(
      code_of(tcpm + "L X-20 Y-20 R0 FMAX\nFUNCTION RESET TCPM\nL X-20 Y-20 R0 FMAX\n" + contour),
      0);
}

// M114 of older controls lets RL and RR stop with an error.
TEST(KlartextOff, ThePlaceOfTurnedAxesIsNoPartOfAContour) {
  EXPECT_EQ(code_of("M114 B+45\n" + contour), 900003);
  EXPECT_EQ(code_of("M114 B+45\nM115\nL X-20 Y-20 R0 FMAX\n" + contour), 0);
  const std::string within = "L X+0 Y+0 RL F300\nL Y+40\n";
  const std::string begin = "L X-20 Y-20 R0 FMAX\n";
  for (const std::string function : {"M114", "M130"})
    EXPECT_EQ(code_of(begin + within + "L X+20 " + function + "\nL X+40\nL Y+80 R0\n"), 900003)
        << function;
  // M130: only the control knows where that is.
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX M130\n" + step), 900106);
}

// V of M200 to M204 is a voltage.
TEST(KlartextOff, WordsOfTheLaserStayAfterTheirFunction) {
  const std::string text =
      "BEGIN PGM A MM\nL X-20 Y-20 R0 FMAX\nL X+0 Y+0 RL F300\nL Y+40 M200 "
      "V5\nL X+40 Y+80\nL X+60 R0\nM30\nEND PGM A MM\n";
  const ProgramRun ran = to_text(text, computing_setup(DialectName::heidenhain));
  EXPECT_NE(ran.text.find(" M200 V5\n"), std::string::npos) << ran.report();
}

// Holes about a pole: only the control knows where the tool stands after a cycle.
TEST(KlartextOff, HolesOfACircleAreCopied) {
  const std::string drill = "CYCL DEF 200 DRILLING Q200=2\n";
  for (const std::string holes :
       {"CC X+50 Y+50\nLP PR+30 PA+0 R0 FMAX\nCYCL CALL\nLP PA+60\nCYCL CALL\nLP PA+120 M99\n",
        "CC X+50 Y+50\nLP PR+30 PA+0 R0 FMAX M99\nLP IPA+60 M99\nLP IPA+60 R0 FMAX M99\n",
        "CC X+50 Y+50\nLP PR+30 PA+0 R0 FMAX M99\nLP IPR+5 IPA+60 M99\nLP PA+90\n"}) {
    const std::string program = "BEGIN PGM A MM\nTOOL CALL 5 Z S5000\n" + drill + holes + "M30\n";
    EXPECT_EQ(text_of(program), program);
    const std::string behind =
        text_of("BEGIN PGM A MM\nTOOL CALL 5 Z S5000\nL X-20 Y-20 R0 FMAX\n" + contour + drill +
                holes + "M30\n");
    EXPECT_NE(behind.find(holes), std::string::npos) << behind;
    EXPECT_EQ(code_of(drill + holes + step), 900106);
    EXPECT_EQ(code_of(drill + holes + "L X-20 Y-20 R0 FMAX\n" + contour), 0);
  }
  // The contour has a pole of its own, and LP no place without one.
  const std::string rounded =
      "L X-20 Y-20 R0 FMAX\nL X+0 Y-10 RL F200\nL Y+40\nL X+40\nL X+60 R0\n";
  EXPECT_EQ(code_of("CC X+50 Y+50\nCYCL CALL\n" + rounded + "LP PR+30 PA+60 R0 FMAX\n"), 900003);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nLP PR+30 PA+60 R0 FMAX\n"), 900003);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nCC X+0 Y+0\nLP PA+60 R0 FMAX\n"), 900003);
}

// The contour has left a pole of its own in the output.
TEST(KlartextOff, WhatIsCopiedAfterAContourHasItsPoleAgain) {  // D-131
  const std::string rounded =
      "L X-20 Y-20 R0 FMAX\nL X+0 Y-10 RL F200\nL Y+40\nL X+40\nL X+60 R0\n";
  for (const std::string copied :
       {"C X+Q1 Y+Q2 DR+\n", "LP PR+Q5 PA+90 R0 FMAX\n", "CP PA+Q3 DR+\n"}) {
    const std::string text =
        text_of("BEGIN PGM A MM\nTOOL CALL 5 Z\nCC X+50 Y+50\n" + rounded + copied + "M30\n");
    EXPECT_NE(text.find("L X+60 Y+40\nCC X+50 Y+50\n" + copied), std::string::npos) << text;
  }
}

TEST(KlartextOff, ALoneMOfOlderControlsIsNoFunction) {
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX M\nL X+0 Y-10 RL F200 M\nL Y+40 M ; up\nL X-20 R0 M\n"),
            0);
  EXPECT_EQ(code_of("L X-20 Y-20 R0 M FMAX\n"), 900003);
}

TEST(KlartextOff, CyclesThatMoveAtOnce) {  // D-115
  for (const std::string moving :
       {"TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5\n",
        "TCH PROBE 413 DATUM OUTSIDE CIRCLE ~\n  Q321=+50 ;CENTRE ~\n  Q322=+50 ;CENTRE\n",
        "CYCL DEF 220 POLAR PATTERN Q216=+50 Q217=+50\n", "CYCL DEF 221 CARTESIAN PATTERN Q225=5\n",
        "CYCL DEF 224 DATAMATRIX CODE PATTERN Q458=0\n"}) {
    EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\n" + moving + step), 900106) << moving;
    EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\n" + moving + "L X-20 Y-20 R0 FMAX\n" + contour), 0)
        << moving;
    EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nL X+0 Y-10 RL F200\n" + moving + "L Y+40\nL X-20 R0\n"),
              900003)
        << moving;
  }
  EXPECT_EQ(code_of("L X-20 Y-20 R0 FMAX\nCYCL DEF 200 DRILLING Q200=2\n" + contour), 0);
}

}  // namespace
}  // namespace trc::support
