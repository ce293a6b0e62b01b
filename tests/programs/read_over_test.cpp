#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/programs/computing.h"

// No word of a line is ignored: a word is followed, refused where it is not understood, or copied
// where TRC need not follow it.

namespace trc::support::read_over {
namespace {

using enum DialectName;

using Lines = std::vector<std::pair<std::string, std::string>>;

ProgramSessionSetup setup_of(DialectName dialect) {
  ProgramSessionSetup setup = computing_setup(dialect, 0);
  setup.session.program.tools = {{row_of_edge(1, 1), 5}, {row_of_edge(2, 1), 3}};
  return setup;
}

// Code, line and detail of each error.
std::string told(const std::string& text, const ProgramSessionSetup& setup) {
  std::string all;
  for (const Diagnostic& found : to_text(text, setup).diagnostics)
    if (found.severity == Severity::error)
      all += std::to_string(static_cast<int>(found.code)) + " " +
             std::to_string(found.source.line) + " " + found.detail + "\n";
  return all;
}

// The output, or the report of a program that has none.
std::string written(const std::string& text, const ProgramSessionSetup& setup) {
  const ProgramRun ran = to_text(text, setup);
  return ran.stopped ? told(text, setup) : ran.text;
}

std::string sinumerik_contour(const std::string& lines) {
  return "G71 G90 G17\nT1 D1\nM6\nG0 X-30 Y-30\n" + lines +
         "\nG41 G1 X0 Y-10 F100\nY40\nX40\nG40 Y-30\nM30\n";
}

// Of EdingCNC. What DlgMsg asks for changes a variable.
TEST(ReadOver, MessagesForTheOperatorPass) {
  for (const DialectName dialect : {fanuc, linuxcnc}) {
    const std::string text =
        "G21 G90\nmsg \"tool 5\" (flat)\nN5 DlgMsg \"Ready?\"\n"
        "LogFile \"a.txt\" 1\nLOGMSG \"x \" 5\nM30\n";
    EXPECT_EQ(written(text, setup_of(dialect)), text);
    EXPECT_EQ(told("G21 G90\nDlgMsg \"Width?\" \"w\" 1\nM30\n", setup_of(dialect)),
              "900003 2 DLGMSG, a statement\n");
    EXPECT_EQ(told("G21 G90\nMSG G1 X10\nM30\n", setup_of(dialect)), "900003 2 MSG, a statement\n");
  }
}

TEST(ReadOver, APointAfterAnExpressionIsThatOfItsNumber) {
  EXPECT_EQ(written("#1=500\nM03 S[#1]. F[#1+1].\nG1 X[#1].\nM30\n", setup_of(fanuc)),
            "M03 S500 F501.\nG1 X500.\nM30\n");
}

TEST(ReadOver, AToolOfTheSpindleIsItsTool) {  // D-92
  ProgramSessionSetup setup = setup_of(sinumerik);
  setup.session.program.tool_names["FR6"] = row_of_edge(2, 1);
  for (const char* const change :
       {"T2 D1\nM6", "T1=2\nM6", "T1=2 M1=6", "T=2\nM1=6", "T1=\"FR6\" M1=6", "T=\"FR6\" M6"}) {
    const std::string text = written(sinumerik_contour(change), setup);
    EXPECT_NE(text.find("Y43"), std::string::npos) << change << '\n' << text;
  }
  for (const auto& [line, refused] :
       Lines{{"T2=2", "900003 5 T2=2, the tool of another spindle\n"},
             {"M2=6", "900003 5 M2=6, the tool of another spindle\n"},
             {"D1=2", "900003 5 D1=2, with the number of a spindle\n"},
             {"M1=30", "900003 5 M1=30, with the number of a spindle\n"},
             {"F1=30", "900003 5 F1=30, with the number of a spindle\n"}})
    EXPECT_EQ(told(sinumerik_contour(line), setup), refused) << line;
  for (const char* const line : {"S1=500 M1=3", "M2=3", "H1=5"})
    EXPECT_EQ(told(sinumerik_contour(line), setup), "") << line;
}

// A number says where a turning axis stops, not which way it goes there.
TEST(ReadOver, TheWayRoundIsKeptOrRefused) {  // D-92
  const ProgramSessionSetup setup = setup_of(sinumerik);
  const auto in_contour = [](const std::string& word) {
    return "G71 G90 G17\nT1 D1\nG0 X-30 Y-30 C0\nG41 G1 X0 Y-10 F100\nY40 " + word +
           "\nX40\nG40 Y-30\nM30\n";
  };
  for (const std::string word : {"C=DC(10)", "C=ACP(350)", "c=acn( 350 )"})
    EXPECT_EQ(told(in_contour(word), setup),
              "900003 5 DC, ACP or ACN, a way round, beside a contour\n")
        << word;
  EXPECT_EQ(told(in_contour("C=AC(10)"), setup), "");
  // After a contour a line may be written anew.
  const std::string behind = "G0 X-30 Y-30 C=DC(0)\nG41 G1 X0 Y-10 F100\nY40\nX40\nG40 Y-30\n";
  for (const std::string line : {"G0 X5 C=ACN(350)", "X5 C=DC(10)", "C=ACP(20)"}) {
    const std::string text = written("G71 G90 G17\nT1 D1\n" + behind + line + "\nM30\n", setup);
    EXPECT_NE(text.find(line.substr(line.find('C'))), std::string::npos) << text;
    EXPECT_NE(text.find("C=DC(0)"), std::string::npos) << text;
  }
}

TEST(ReadOver, WhatGoesOnFromAMotionOfTheContourIsRefused) {  // D-92
  const auto behind = [](const std::string& lines) {
    return "G71 G90 G17\nT1 D1\nG0 X0 Y0 Z5\nG41 G1 X10 Y10 F100\nY90\nX90\n" + lines + "\nM30\n";
  };
  const ProgramSessionSetup setup = setup_of(sinumerik);
  const std::string refused = "CT after a motion of the contour: program its centre\n";
  EXPECT_EQ(told(behind("G40 X150 Y60\nCT X160 Y20"), setup), "900003 8 " + refused);
  EXPECT_EQ(told(behind("G40 X150 Y60\nG0 Z9\nG111 X5 Y5\nCT X160 Y20"), setup),
            "900003 10 " + refused);
  EXPECT_EQ(told(behind("G40 X150 Y60\nG1 X160\nCT X170 Y20\nCT X180 Y40"), setup), "");
}

// The tool goes to the contour on another line than the one that is rounded into.
TEST(ReadOver, ARoundingIntoTheApproachIsRefused) {  // D-92
  const std::string fanuc_contour = "G41 D1 G1 X10. Y10.\nY40.\nX40.\nG40 Y60.\nM30\n";
  const auto fanuc_told = [&](const std::string& lines) {
    return told("G21 G90 G17\nT1 M6\nG0 X0. Y0.\n" + lines + fanuc_contour, setup_of(fanuc));
  };
  const std::string refused = "a rounding or a chamfer before the motion that selects TRC\n";
  EXPECT_EQ(fanuc_told("G1 X0. Y5. F100 ,R2.\n"), "900003 4 " + refused);
  EXPECT_EQ(fanuc_told("G1 X0. Y5. F100 ,C2.\n(next)\n"), "900003 4 " + refused);
  EXPECT_EQ(fanuc_told("G1 X0. Y5. F100 ,R2.\nX5.\n"), "");
  EXPECT_EQ(fanuc_told("G1 X0. Y5. F100 ,R0\n"), "");
  EXPECT_EQ(told(sinumerik_contour("G1 X-20 RND=2 F100"), setup_of(sinumerik)),
            "900003 5 " + refused);
  EXPECT_EQ(told("BEGIN PGM A MM\nTOOL CALL 1 Z\nL X-30 Y-30 R0 FMAX\nL X-20 F100\nRND R2\n"
                 "L X+0 Y-10 RL\nL Y+40\nL X+40 R0\nEND PGM A MM\n",
                 setup_of(heidenhain)),
            "900003 5 RND or CHF before the motion that selects TRC\n");
}

TEST(ReadOver, EveryWordOfKlartextCounts) {  // D-90
  const auto in_contour = [](const std::string& line) {
    return "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nCC X+0 Y+0\nL X-30 Y-30 Z-5 R0 FMAX M3\n"
           "L X+0 Y-10 RL F100\nL Y+40\n" +
           line + "\nL X+60 Y+45\nL Y-20\nL X+90 R0\nEND PGM A MM\n";
  };
  const ProgramSessionSetup setup = setup_of(heidenhain);
  for (const auto& [line, refused] : Lines{{"RND R6 M0", "900003 7 a stop beside RND\n"},
                                           {"CHF 3 M1", "900003 7 a stop beside CHF\n"},
                                           {"RND R6 X+1", "900003 7 X beside RND\n"},
                                           {"RND R6 A+5", "900003 7 A beside RND\n"},
                                           {"CHF 3 Z-6", "900003 7 Z beside CHF\n"},
                                           {"L X+40 PA+5", "900003 7 PA beside L\n"},
                                           {"L X+40 IPA5", "900003 7 PA beside L\n"},
                                           {"L X+40 PR5", "900003 7 PR beside L\n"},
                                           {"L X+40 LEN5", "900003 7 LEN beside L\n"},
                                           {"L X+40 CCA5", "900003 7 CCA beside L\n"},
                                           {"L X+40 R5", "900003 7 R beside L\n"},
                                           {"L X+40 DR+", "900003 7 DR beside L\n"},
                                           {"M8 X+40", "900003 7 X beside M\n"}})
    EXPECT_EQ(told(in_contour(line), setup), refused) << line;
  for (const char* const line : {"RND R6 M8", "CHF 3 F50", "L X+40 M0", "M8"})
    EXPECT_EQ(told(in_contour(line), setup), "") << line;
}

TEST(ReadOver, EveryWordOfALeadOfKlartextCounts) {  // D-90
  const auto with = [](const std::string& approach, const std::string& departure) {
    return "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nCC X+0 Y+0\nL X-60 Y-60 Z-5 R0 FMAX M3\n" +
           approach + "\nL Y+40\nL X+60\n" + departure + "\nL Z+50 FMAX\nEND PGM A MM\n";
  };
  const ProgramSessionSetup setup = setup_of(heidenhain);
  const std::string approach = "APPR LT X+0 Y-10 LEN10 RL F100";
  EXPECT_EQ(told(with(approach, "DEP LT LEN20"), setup), "");
  for (const auto& [word, name] :
       Lines{{"A+5", "A"}, {"PR+10", "PR"}, {"PA+0", "PA"}, {"R5", "R"}, {"CCA90", "CCA"}}) {
    EXPECT_EQ(told(with(approach + " " + word, "DEP LT LEN20"), setup),
              "900003 5 " + name + " beside APPR LT\n");
    EXPECT_EQ(told(with(approach, "DEP LT LEN20 " + word), setup),
              "900003 8 " + name + " beside DEP LT\n");
  }
  EXPECT_EQ(told(with("APPR LCT PR+10 PA+0 R5 RL F100", "DEP LT LEN20"), setup),
            "900003 5 PR beside APPR LCT\n");
  EXPECT_EQ(told(with(approach, "DEP LCT PR+90 PA+0 R5"), setup), "900003 8 PR beside DEP LCT\n");
  EXPECT_EQ(told(with(approach, "DEP LCT X+90 Y+10 R5 LEN5"), setup),
            "900003 8 LEN beside DEP LCT\n");
}

// As CAM systems lead a tool into and out of its depth. Only what counts on the place is refused.
TEST(ReadOver, ArcsAcrossThePlaneAreCopied) {  // D-91
  const ProgramSessionSetup setup = setup_of(heidenhain);
  const auto with = [](const std::string& lead, const std::string& place) {
    return "BEGIN PGM A MM\nTOOL CALL 1 Z S3000\nL X-20 Y-20 R0 FMAX\nL Z-14 F402\n" + lead +
           place + "L X+0 Y-10 RL F300\nL Y+40\nL X+40\nL Y-30 R0\nL Z+50 FMAX M30\nEND PGM A MM\n";
  };
  const std::string place = "L X-16 Y-16 Z-16 R0\n";
  for (const std::string lead :
       {"CC X-18 Z-14\nCP IPA-90 DR- F1206\n", "CC X-18 Z-14\nC X-18 Z-16 DR-\n",
        "CR X-18 Z-16 R2 DR-\n", "CC Y-18 Z-14\nCP IPA-90 DR-\n", "CC X-18 Z-14\n"}) {
    const std::string text = written(with(lead, place), setup);
    EXPECT_NE(text.find(lead + place), std::string::npos) << text;
    EXPECT_NE(text.find("X-5"), std::string::npos) << text;
  }
  // Y is where it was, X is not.
  const std::string alone = "CC X-18 Z-14\nCP IPA-90 DR-\n";
  EXPECT_EQ(refusal_of(with(alone, "L IX+1\n"), setup), std::pair(900106, 7U));
  EXPECT_EQ(told(with(alone, "L X-16\n"), setup), "");
  // In a contour it is none of the plane.
  const std::string contour = with("", place);
  const std::size_t end = contour.find("L X+40");
  for (const std::string line : {"CC X+0 Z+5\n", "CR X+10 Z-20 R20 DR+\n"})
    EXPECT_EQ(refusal_of(contour.substr(0, end) + line + contour.substr(end), setup),
              std::pair(900003, 8U))
        << line;
}

TEST(ReadOver, SwitchesOfTheMachinePass) {  // D-93
  const std::string text =
      "G21 G90 G17\nT1 M6\n#3003=1\nG0 X-30. Y-30.\n#3001=0 (clock)\nG41 D1 G1 X0 Y-10. F100\n"
      "#3004=7\nY40.\nX40.\nG40 Y-30.\n#3003=0\nM30\n";
  const std::string flat = written(text, setup_of(fanuc));
  for (const char* const line : {"#3003=1\n", "#3001=0 (clock)\n", "#3004=7\n", "#3003=0\n"})
    EXPECT_NE(flat.find(line), std::string::npos) << flat;
  EXPECT_EQ(refusal_of("G21\n#3003=#0\nM30\n", setup_of(fanuc)).first, 900307);
  EXPECT_EQ(written("G21\n#12001=-0.02\nM30\n", setup_of(fanuc)), "G21\nG10 L13 P1 R-0.02\nM30\n");
  EXPECT_EQ(told("G21\n#1=5 #2=6\nM30\n", setup_of(fanuc)),
            "900308 2 #, a second assignment: one in a block\n");
  EXPECT_EQ(flat_of("G21\n(B) #1=5\nG0 X#1\nM30\n", setup_of(fanuc)), "G21\n(B)\nG0 X5.\nM30\n");
}

// A pole moves nothing.
TEST(ReadOver, APoleInPolarFormLeavesThePlaceKnown) {
  const std::string line = "G110 AP=0 RP=30";
  EXPECT_EQ(told(sinumerik_contour(line), setup_of(sinumerik)), "");
  EXPECT_NE(written(sinumerik_contour(line), setup_of(sinumerik)).find(line), std::string::npos);
}

// `/` within a line leaves out what stands after it.
TEST(ReadOver, ASwitchWithinALineHoldsForWhatStandsAfterIt) {  // D-93
  const auto with = [](const std::string& line) {
    return "G21 G90 G17\nT1 M6\nG0 X-30. Y-30.\nG41 D1 G1 X0 Y-10. F100\nY40.\n" + line +
           "\nY-10.\nG40 Y-30.\nM30\n";
  };
  ProgramSessionSetup setup = setup_of(fanuc);
  EXPECT_EQ(told(with("X40. /M8"), setup), "");
  EXPECT_NE(written(with("X40. /M8"), setup).find("/ M8"), std::string::npos);
  EXPECT_EQ(refusal_of(with("X40. /F50."), setup), std::pair(900017, 6U));
  for (const auto& [skip, same] : {std::pair{BlockSkip::execute, "X40. F50. (slow)"},
                                   std::pair{BlockSkip::leave_out, "X40. (slow)"}}) {
    setup.session.program.block_skip = skip;
    EXPECT_EQ(written(with("X40. /F50. (slow)"), setup), written(with(same), setup));
  }
}

TEST(ReadOver, OneProgramHasOneBeginAndItsBranchesTheirs) {
  EXPECT_EQ(told("BEGIN PGM 1 INCH\nBEGIN PGM X MM\nL X+1\nEND PGM X MM\n", setup_of(heidenhain)),
            "900003 2 BEGIN PGM, a second program in one text\n");
  EXPECT_EQ(told("G71\nR1=1\nENDIF\nG0 X1\nM30\n", setup_of(sinumerik)),
            "900310 3 ENDIF without IF\n");
  EXPECT_EQ(told("G71\nR1=1\nIF R1==1\nG0 X1\nELSE\nG0 X2\nENDIF\nIF R1==2\nG0 X3\nENDIF\nM30\n",
                 setup_of(sinumerik)),
            "");
  EXPECT_EQ(told("G21\nG0 X1\nM30\n", setup_of(sinumerik)),
            "900003 1 G21, mm of the ISO mode: write G71, or declare the dialect FANUC\n");
}

}  // namespace
}  // namespace trc::support::read_over
