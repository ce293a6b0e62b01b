#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/programs/computing.h"

// All that stands against a program which computes is told in one run.

namespace trc::support {
namespace {

// `code line detail` of each error, in the order in which they are told.
std::string told(const std::string& text, DialectName dialect,
                 const std::map<std::string, std::string>& subprograms = {}) {
  ProgramSessionSetup setup = computing_setup(dialect);
  setup.session.program.subprograms = {subprograms.begin(), subprograms.end()};
  const ProgramRun ran = to_text(text, setup);
  std::string all;
  for (const Diagnostic& found : ran.diagnostics) {
    if (found.severity != Severity::error) continue;
    all += std::to_string(static_cast<int>(found.code)) + ' ' + std::to_string(found.source.line) +
           ' ' + found.detail;
    for (const CallPlace& call : found.calls)
      all += " in " + call.subprogram + ':' + std::to_string(call.line_within);
    all += '\n';
  }
  return ran.stopped ? all : "accepted\n";
}

TEST(ToldTogether, OfFanucAreStateAndWordsAndCalls) {
  EXPECT_EQ(told("G21 G90 G17\n#1=#5041\nG0 X#1 Y#5042\nIF [#1 GT 5] GOTO 10\nG45 Z5.\n"
                 "M98 P1234\nN10 G777\nM98 P1235\nG0 X#501\nM30\nG888\n",
                 DialectName::fanuc),
            "900307 2 #5041\n900307 3 #5042\n900003 5 G45, tool offset increase\n900306 6 O1234\n"
            "900002 7 G777\n900306 8 O1235\n900303 9 #501\n");
}

// What else is wrong in a program of another dialect is wrong in this one alone.
TEST(ToldTogether, OfAnotherDialectIsThatAlone) {
  const std::string all = told(
      "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL Z+50 R0 FMAX\nAPPR LCT X+5 Y+5 R5 RL F300\n"
      "RND R10\nCT X+40 Y+5\nEND PGM A MM\n",
      DialectName::isg);
  EXPECT_NE(all.find("900016 1 "), std::string::npos) << all;
  EXPECT_EQ(all.find("900003"), std::string::npos) << all;
}

// A section that is repeated has each of its lines once.
TEST(ToldTogether, OfASectionThatIsRepeatedAreItsLines) {
  const std::string text =
      "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S2000\n2 LBL 1\n3 L X-30 Y+20 R0 FMAX\n"
      "4 L X+0 Y+20 RL F300\n5 FL PR+10\n6 FL PR+10\n7 L X-30 Y+20 R0\n8 CALL LBL 1 REP 4\n"
      "9 L X+5 Y+5 RL F300\n10 FL PR+10\n11 L X-30 R0\n12 END PGM A MM\n";
  const ProgramRun ran = to_text(text, computing_setup(DialectName::heidenhain));
  ASSERT_TRUE(ran.stopped);
  const std::vector<DiagnosticValue>& values = ran.diagnostics.at(0).values;
  ASSERT_EQ(values.size(), 1U) << ran.report();
  EXPECT_EQ(values[0].name, "lines");
  EXPECT_EQ(values[0].value, 3) << ran.report();
}

// While a value is unknown, what depends on it is no error.
TEST(ToldTogether, AreNoConsequences) {
  EXPECT_EQ(told("#1=#5041\n#2=1/[#1-1]\nGOTO#1\nM98 P#1\nIF [#1 EQ 1] THEN #3000=1(NO)\n"
                 "F[#4] X[#5]\nG#1\nM30\n",
                 DialectName::fanuc),
            "900307 1 #5041\n");
}

// The lathe is one cause, whatever else of the program shows it.
TEST(ToldTogether, AreNoFurtherSignsOfALathe) {
  EXPECT_EQ(told("N10 G18 G54 DIAMON G90\nN40 G0 X60 Z2\nN50 G42 G1 X40 Z0 F0.2\nN60 Z-30\n"
                 "N70 X50\nN80 G40 G0 X100 Z100\nN90 M30\n",
                 DialectName::sinumerik),
            "900018 1 DIAMON\n");
}

TEST(ToldTogether, OfFanucAreThoseOfSubprograms) {
  EXPECT_EQ(told("#1=#5041\nM98 P100\nG65 P200 A1.\nM30\nO100\nG778\nM99\nO200\nX#1\nG779\nM99\n"
                 "O300\nG780\nM99\n",
                 DialectName::fanuc),
            "900307 1 #5041\n900002 6 G778 in O0100:0\n900002 10 G779 in O0200:0\n");
  EXPECT_EQ(told("#1=#5041\nM98 P100\nM30\n", DialectName::fanuc, {{"O100", "G1\nG778\nM99\n"}}),
            "900307 1 #5041\n900002 2 G778 in O0100:2\n");
  // The refusal is in the subprogram that is called.
  EXPECT_EQ(told("M98 P100\nG779\nM30\nO100\nX#5041\nG778\nM99\n", DialectName::fanuc),
            "900307 5 #5041 in O0100:0\n900002 6 G778 in O0100:0\n900002 2 G779\n");
}

TEST(ToldTogether, AreCountedByTheirLines) {
  EXPECT_EQ(told("#1=#5041\n#2=#5041\nX#5041 Y#5041\nM30\n", DialectName::fanuc),
            "900307 1 #5041\n");
}

TEST(ToldTogether, OfLinuxcncAreStateAndWordsAndCalls) {
  EXPECT_EQ(told("G21 G90 G17\n#1=#5420\no100 sub\nG123\no100 endsub\nG0 X#<depth> Y#<_x>\n"
                 "o200 call [1]\no101 if [#1 GT 5]\nG334 Z5\no101 endif\no100 call\nM2\n",
                 DialectName::linuxcnc),
            "900307 2 #5420\n900303 6 #<depth>\n900307 6 #<_x>\n900306 7 o200\n"
            "900002 9 G334\n900002 4 G123 in o100:0\n");
}

TEST(ToldTogether, OfSinumerikAreStateAndWordsAndCalls) {
  EXPECT_EQ(told("DEF REAL DEPTH\nG17 G90\nR1=$AA_IM[X]\nIF R1>5 GOTOF ENDE\nDEPTH=R1+R7\n"
                 "G777\nX=DEPTH+$AA_IW[Y]\nL12\nWHILE R1<7\nG778\nENDWHILE\nENDE: M30\n",
                 DialectName::sinumerik),
            "900307 3 $AA_IM[X]\n900303 5 R7\n900002 6 G777\n900307 7 $AA_IW[Y]\n900306 8 L12\n"
            "900002 10 G778\n");
}

// A program that ends by itself, or for ever, has said what it has to say.
TEST(ToldTogether, AreNotThoseAfterAnAlarm) {
  EXPECT_EQ(told("#3000=1 (NO TOOL)\nG777\nM30\n", DialectName::fanuc),
            "900312 1 #3000=1 (NO TOOL)\n");
}

// A call is executed after its line, whose words are told at their own place.
TEST(ToldTogether, WordsBesideACallStandInItsLine) {
  EXPECT_EQ(told("O1\nG777 M98 P2000\nM30\nO2000\nG1 X0\nM99\n", DialectName::fanuc),
            "900002 2 G777\n");
  EXPECT_EQ(told("FOO KONTUR\nM30\n", DialectName::sinumerik, {{"KONTUR.SPF", "G0 X0\nM17\n"}}),
            "900003 1 FOO, a name\n");
}

// While lines are only examined, a called label stands after the end of the program.
TEST(ToldTogether, OfKlartextAContourInALabelIsNoneAfterTheEnd) {
  EXPECT_EQ(told("BEGIN PGM A MM\nTOOL CALL 1 Z S1\nL X+0 Y-20 R0 FMAX\nCALL LBL 9\nCALL LBL 1\n"
                 "L Z+100 R0 FMAX M2\nLBL 1\nL X+0 Y+0 RL F200\nL X+50\nL X+60 Y-20 R0\nLBL 0\n"
                 "END PGM A MM\n",
                 DialectName::heidenhain),
            "900306 4 LBL 9\n");
}

TEST(ToldTogether, OfKlartextAMissingRadiusIsOneFaultOfMany) {
  ProgramSessionSetup setup = computing_setup(DialectName::heidenhain, 0);
  const ProgramRun ran = to_text(
      "BEGIN PGM A MM\nTOOL CALL 1 Z S1\nL X-20 Y-20 R0 FMAX\nL X+0 Y+0 RL F200\nL Y+40 M97\nFLT\n"
      "L X-20 Y-20 R0 M2\nEND PGM A MM\n",
      setup);
  ASSERT_EQ(ran.diagnostics.size(), 3U) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].code, Code::no_tool_radius);
  EXPECT_EQ(ran.diagnostics[0].detail, "RL or RR in line 4");
  EXPECT_EQ(ran.diagnostics[1].source.line, 5U);
  EXPECT_EQ(ran.diagnostics[2].source.line, 6U);
}

// D-171
TEST(ToldTogether, OfKlartextAreCornersWhereContoursBeginAndEnd) {
  EXPECT_EQ(told("BEGIN PGM A MM\nTOOL CALL 1 Z S1\nL X-20 Y-20 R0 FMAX\nL RL F200\nL X+0 Y+0\n"
                 "RND R5\nL Y+60\nRND R5\nL X+60\nRND R5\nL X+80 Y+80 R0\n"
                 "APPR LCT X+0 Y+0 R3 RL\nCHF 3\nL Y+60\nRND R5\nL X+60\nRND R0.0\n"
                 "L X+80\nL Z-5\nRND R4\nDEP LT LEN9\nM2\nEND PGM A MM\n",
                 DialectName::heidenhain),
            "900003 6 RND as a smooth approach\n900003 10 RND as a smooth departure\n"
            "900003 13 CHF where a contour begins\n900003 20 RND where a contour ends\n");
}

}  // namespace
}  // namespace trc::support
