#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/programs/computing.h"

// What is refused says why in words of its own, at the word that is meant, with a remedy that
// helps.

namespace trc::support {
namespace {

using enum DialectName;

struct Told {
  DialectName dialect = isg;
  std::string text{};
  std::string place{};  // line:column code
  std::string detail{};
  std::string help{};  // part of it
};

std::ostream& operator<<(std::ostream& out, const Told& told) { return out << told.detail; }

class Remedy : public ::testing::TestWithParam<Told> {};

TEST_P(Remedy, FitsWhatIsRefused) {
  const Told& wanted = GetParam();
  const ProgramRun ran = to_text(wanted.text, computing_setup(wanted.dialect, 2));
  const auto found = std::ranges::find(ran.diagnostics, Severity::error, &Diagnostic::severity);
  ASSERT_NE(found, ran.diagnostics.end());
  EXPECT_EQ(std::to_string(found->source.line) + ":" + std::to_string(found->column) + " " +
                std::to_string(static_cast<int>(found->code)),
            wanted.place);
  EXPECT_NE(found->detail.find(wanted.detail), std::string::npos) << found->detail;
  EXPECT_NE(help_of(*found).find(wanted.help), std::string::npos) << help_of(*found);
  EXPECT_NE(help_of(*found, Language::german), help_of(*found));
}

// Each line of such a text has several faults.
TEST(Encoding, IsToldOnceForATextInUtf16) {
  using namespace std::string_literals;
  const std::string little =
      "G\0"
      "0\0 \0X\0"
      "0\0\r\0\n\0#\0"
      "1\0=\0"
      "2\0\r\0\n\0"s;
  const std::string big =
      "\0G\0"
      "0\0 \0X\0"
      "0\0\r\0\n\0#\0"
      "1"s;
  for (const DialectName dialect : {isg, fanuc, linuxcnc, sinumerik, heidenhain})
    for (const std::string& text : {"\xFF\xFE" + little, little, "\xFE\xFF" + big})
      for (const std::size_t piece : {0UL, 1UL, 3UL}) {
        const ProgramRun ran = to_text(text, computing_setup(dialect, 2), piece);
        ASSERT_EQ(ran.codes(), "900007 at line 1");
        EXPECT_EQ(ran.diagnostics.front().detail, "text in UTF-16");
        EXPECT_EQ(help_of(ran.diagnostics.front()),
                  "Save the program as plain text in UTF-8 or ASCII.");
        EXPECT_EQ(ran.text, "");
      }
  // A NUL before the tape.
  EXPECT_NE(to_text("\0%\nO1\nG0 X0\nM30\n"s, computing_setup(fanuc)).diagnostics.at(0).detail,
            "text in UTF-16");
}

const std::string at_start = "G21 G90 G17\nG0 X-10. Y-10.\n";
// The tool has not left the contour: no motion in the plane follows G40.
const std::string beside_contour =
    "G71 G90 G17 G0 X-20 Y-20\nG41 G1 X0 Y-10 F500\nY40\nX50\nG40\nG0 Z50\n";
const std::string in_isg_contour = "G90 G17 G0 X0 Y0\nG41 G1 X5 F100\nY9\n";
const std::string klartext_start = "BEGIN PGM A MM\nL X-20 Y-20 R0 FMAX\n";

INSTANTIATE_TEST_SUITE_P(
    Programs, Remedy,
    ::testing::Values(
        Told{heidenhain,
             "0 BEGIN PGM A MM\n1 LBL 1\n2 L X-9 Y+0 FMAX\n3 L X+0 Y+0 RL F100\n4 L Y+9\n"
             "5 L X-9 R0\n6 FN 11: IF +Q1 GT +0 GOTO LBL 1\n7 END PGM A MM\n",
             "7:3 900003", "FN 11, a jump to a label", "CALL LBL 1 REP 3"},
        Told{fanuc, at_start + "G1 G41 D.25 X0. Y0. F200\nX10.\nG40 X20.\nM30\n", "3:8 900008",
             "is the number of a register", "Write the number of the register"},
        Told{fanuc, "G21 G90 G17\nX-20. Y-20. G0 G54 N20 S2000 M3\nM30\n", "2:20 900001",
             "N20, a block number after other words", "before all other words"},
        Told{fanuc, "%\nZ4.\nO7\nG21 G90 G0 X0\nM30\n%\n", "3:1 900003",
             "O, after blocks without a number", "Take the blocks before it out"},
        Told{fanuc, "%\nO6\nZ4.\nO7\nG21 G90 G0 X0\nM30\n%\n", "4:1 900003",
             "O, a second program in one text", "as a text of its own"},
        Told{fanuc, at_start + "G93\nG1 G41 X0. Y0. F10.\nX10. F20.\nG40 X20.\nM30\n", "4:8 900003",
             "G93, the time of a block, in force since line 3", "Write G94"},
        Told{fanuc, "G20 G90\n#10100 = 0.0\nG0 X[1+#10100]\nM30\n", "2:1 900307",
             "a variable of Haas or a tool offset of Fanuc", "#100 for #10100"},
        Told{fanuc, "G21 G90\n#1=2\nWHILE [#1 GT 0] DO1 #1=#1-1\nG0 X#1\nEND1\nM30\n",
             "3:21 900308", "#, words after a statement", "into a line of its own"},
        Told{fanuc, "G21 G90\n#100=1\nN50 [#100 LT 3] M99 P10\nM30\n", "3:5 900003",
             "a condition without IF", "Write IF before it"},
        Told{fanuc, at_start + "G1 X30. Y10. F9\nG3 X40. Y20. I30. J20.\nM30\n", "4:4 20035",
             "which fits where they are absolute", "circle_center_mode.reference ABSOLUTE"},
        Told{linuxcnc, "G21 G90 G17 G90.1\nG0 X30 Y10\nG1 F9 X30\nG3 X40 Y20 I0 J10\nM30\n",
             "4:4 20035", "which fits where they count from the start",
             "circle_center_mode.reference START"},
        Told{fanuc, at_start + "G41 P0.75\nG1 X0 Y0 F200\nX10.\nG40 X20.\nM30\n", "3:5 900003",
             "P beside G41, G42, a radius or a diameter", "Leave P out"},
        Told{fanuc, at_start + "G91 G10 L13 P1 R0.1\nG90\nM30\n", "3:5 900003",
             "G10 L13, a sum of a tool radius", "Write the value itself under G90"},
        Told{sinumerik, "G71 G90 G17\nG0 X-20 Y-20\nG41 G1 X0 Y0 F500\nX=R1\nG40 X-20\nM30\n",
             "4:1 900003", "X=R1, a variable or an expression", "give it: `variables` of"},
        Told{sinumerik, "G71 G90\nG0 X1=5\nM30\n", "2:4 900011", "X1=5", "X for X1"},
        Told{linuxcnc, "G21 G90\nM72\nM2\n", "2:1 900003", "M72, modes as they were at M70",
             "Program the functions that held before once more"},
        // D-113
        Told{linuxcnc, "G21 G90\nM70 G91\nM2\n", "2:1 900003", "M70 beside other words",
             "Write it into a line of its own"},
        Told{isg, "G90 G162\nG01 X10 Y0 F100\nG02 X20 Y0 I5 J0 R5\nM30\n", "3:12 21024", "",
             "Keep either"},
        Told{isg, "G90 G162\nG01 X10 Y0 F100\nG02 X20 Y0 I5 J99999999\nM30\n", "3:12 90133", "",
             "wrong unit"},
        Told{fanuc, "G21 G90\n#2405=8.\nM30\n", "2:1 900307", "#2405, set by the program",
             "G10 L12"},
        Told{sinumerik, "G71 G90\nG0 X0 Y0\nG42 G1 X-10 Y0 Z=R1 F100\nY9\nG40 X9\nM30\n",
             "3:16 900003", "Z=R1, a variable without a value", "--variable"},
        Told{sinumerik, "G71 G90\nG0 X0 Y0\nG42 G1 X25 F100\nX30\nG2 AP=0 RP=25 CR=25\nM30\n",
             "5:15 900003", "a centre or a radius of an arc beside AP=, RP=", "Leave it out"},
        Told{fanuc, at_start + "G1 X10. F100.\nG2 X20. Y0 R0\nM30\n", "4:12 20036", "",
             "a radius other than 0"},
        Told{sinumerik, "G71 G90\nG0 X0 Y0\nCUTCONON\nM30\n", "3:1 900003",
             "CUTCONON, which suppresses TRC", "end the contour before it with G40"},
        Told{sinumerik, "G71 G90\nG0 X0 Y0\nPCALL KONTUR\nM30\n", "3:1 900003",
             "PCALL, a subprogram call", "Write the lines of the subprogram"},
        Told{sinumerik, "G71 G90\nG0 X0 Y0\nCALL BLOCK A TO B\nM30\n", "3:1 900003",
             "CALL, a subprogram call", "Write the lines of the subprogram"},
        Told{sinumerik, "G71 G90\nG0 X20 Y60\nG2 X60 Y60 R40 F500\nM30\n", "3:12 900003",
             "R40, a parameter and no radius", "CR=40"},
        Told{sinumerik, "G71 G90\nG0 X20 Y60\nG42 G1 X0 F500\nG2 X60 Y60 R=40\nM30\n",
             "4:12 900003", "R=40, a parameter and no radius", "CR=40"},
        Told{isg, beside_contour + "G74 X0 Y0\nM30\n", "7:1 900003", "G74 after G40 without motion",
             "Program a motion in the plane after G40"},
        Told{isg, beside_contour + "L UP1\nM30\n", "7:1 900003", "L UP1 after G40 without motion",
             "Program a motion in the plane after G40"},
        Told{isg, "G90 G17 G0 X0 Y0\nG41 G1 X5 F100\nY9\nL UP1\nY20\nG40 X0\nM30\n", "4:1 900003",
             "L UP1, a subprogram that is not given", "--subprograms"},
        Told{isg, "G90 G0 X0 Y0\n$GOTO N70\nX5\nN70 Y0\nM30\n", "2:7 900305",
             "N70, a block without a colon after its number", "N70: Y0"},
        Told{isg, "PROC PART\nG90 G0 X0 Y0\nM30\n", "1:1 900016", "PROC, as in sinumerik",
             "sinumerik"},
        Told{isg, "R1 = -5\nG90 G0 X0 Y0\nM30\n", "1:1 900016", "as in sinumerik", "sinumerik"},
        Told{isg, "G90 G0 X0 Y0\nN10 R1=5\nM30\n", "2:5 900016", "as in sinumerik", "sinumerik"},
        Told{isg, "G90 G0 X0 Y0\nG1 Z=R1 F300\nM30\n", "2:4 900016", "as in sinumerik",
             "sinumerik"},
        Told{isg, "G90 G0 X0 Y0\nG1 G41 NORM G451 X5 Y5 F600\nM30\n", "2:8 900016",
             "as in sinumerik", "sinumerik"},
        Told{fanuc, at_start + "G41.2 D1 G1 X0 Y0 F200\nG40 X20.\nM30\n", "3:1 900003",
             "G41.2, compensation of the tool radius in space", "Let the control compensate"},
        Told{fanuc, at_start + "G41.1 D8.\nM30\n", "3:1 900003", "a correction of LINUXCNC",
             "--dialect linuxcnc"},
        Told{isg, "G90\nG777 X3\nM30\n", "2:1 900002", "G777 with axis words",
             "cannot be passed on"},
        Told{isg, in_isg_contour + "G302 I5\nX9\nM30\n", "4:1 900003", "G302, rounding",
             "Write the corner as blocks of its own"},
        Told{isg, in_isg_contour + "X9 #RND=5\nY5\nM30\n", "4:4 900003", "#RND=5, rounding",
             "Write the corner as blocks of its own"},
        Told{isg, in_isg_contour + "#ROTATION ON [ANGLE=30]\nM30\n", "4:1 900003", "#ROTATION ON",
             "write the coordinates as they are after the rotation"},
        Told{isg, in_isg_contour + "#CONTOUR BEGIN [ID=1]\nM30\n", "4:1 900003", "#CONTOUR BEGIN",
             "does not belong to the contour that is cut here"},
        Told{isg, "G90\n#OTC ON\nM30\n", "2:1 900003", "#OTC ON", "give the tool its radius"},
        Told{fanuc, "CC X+0 Y+0\nM30\n", "1:1 900016", "CC", "Else remove the word"},
        Told{isg, "CC X+0 Y+0\nM30\n", "1:1 900016", "CC", "If it is one for ISG"},
        Told{heidenhain, klartext_start + "CC IX+20\nC X+20 Y+40 DR-\nEND PGM A MM\n", "4:1 900003",
             "C without CC of both axes", "Write CC with both axes"},
        Told{heidenhain,
             klartext_start + "CC X+5 Y+5\nCYCL CALL\nL X+0 Y+0 RL F200\nLP PR+20 PA+0\n"
                              "END PGM A MM\n",
             "6:1 900003", "LP, whose pole is unknown since the change in line 4",
             "Write CC with both axes after the change"},
        Told{heidenhain,
             klartext_start + "L X+0 Y+0 RL F200\nRND R5\nL Y+50\nL X-20 R0\nEND PGM A MM\n",
             "4:1 900003", "RND as a smooth approach", "Write APPR CT"},
        Told{heidenhain,
             klartext_start + "L X+0 Y+0 RL F200\nL Y+50\n9 RND R5\nL X-20 R0\nEND PGM A MM\n",
             "5:3 900003", "RND as a smooth departure", "Write DEP CT"},
        Told{heidenhain,
             klartext_start + "L X+0 Y+0 RL F200\nCHF 5\nL Y+50\nL X-20 R0\nEND PGM A MM\n",
             "4:1 900003", "CHF where a contour begins", "Take it out"},
        Told{heidenhain, "0 BEGIN PGM A MM\n1 L X-20 Y-20\n        R0 F9999 M03\n2 END PGM A MM\n",
             "3:9 900003", "a line without a number, the rest of the block above", "line above"},
        Told{heidenhain, klartext_start + "X+0 Y-10 RL F300\nEND PGM A MM\n", "3:1 900003",
             "X+0 without L, with RL or RR", "Write L before the coordinates"},
        Told{heidenhain,
             klartext_start + "L X+0 Y+0 RL F200\nFCT DR- R15 CCX+50\nL X+9 R0\nEND PGM A MM\n",
             "4:1 900003", "FCT while TRC is active", "convert the free contour"},
        Told{fanuc, "O1\nM98 P2000 K3\nM30\nO2000\nG1 X0\nM99\n", "2:11 900309", "K3 beside M98",
             "M98 P2000 L3"},
        Told{fanuc, at_start + "G41 D1 G1 X0 Y0 F200\nY40. C5.\nG40 X-20.\nM30\n", "4:6 900003",
             "C in a straight motion of a contour", "write ,C with a comma"},
        Told{heidenhain,
             klartext_start + "L X+0 Y+0 RL F200\nL X+50\nL X+60 RR\nL X+9 R0\nEND PGM A MM\n",
             "5:8 900003", "RR after RL without R0 in between", "a motion with R0"}));

// A mill may come down after G41, a lathe goes on without Y (D-105).
TEST(AMillThatComesDownAfterG41, IsNoLathe) {
  const std::string down =
      "G41 D1\nG0 Z5.\nG0 X-5. Y0\nG1 Z-5. F100\nX0 Y0\nX80.\nG40 X99. Y-20.\nM30\n";
  const std::string turned = "G42 D1\nG0 Z5.\nG0 X20.\nG1 Z-20. F1\nX40. Z-40.\nG40 X52.\nM30\n";
  for (const DialectName dialect : {fanuc, linuxcnc, sinumerik}) {
    SCOPED_TRACE(dialect_of(dialect).spelling);
    ProgramSessionSetup setup = computing_setup(dialect, 2);
    const std::string modes = dialect == sinumerik ? "G71 G90 G17\nT1\n" : "G21 G90 G17\n";
    EXPECT_EQ(refusal_of(modes + down, setup), std::pair(0, 0U));
    EXPECT_EQ(refusal_of(modes + turned, setup).first, 900018);
  }
}

// ISG: Y may come later in the contour, and a contour in Z X is one of a mill (D-105).
TEST(AContourOfIsg, IsThatOfALatheIfNothingNamesYBeforeItsEnd) {
  const ProgramSessionSetup setup = computing_setup(isg, 2);
  const std::string head = "G71 G90\nG00 X-20 Z5\n";
  const std::string mill = "G41 X0 Z-2\nG01 X40 Z-5 F300\n";
  EXPECT_EQ(refusal_of(head + mill + "Y40\nG40 X60\nM30\n", setup), std::pair(0, 0U));
  EXPECT_EQ(refusal_of(head + "G41 X0\nG01 X40 F300\nG40 X60 Z5\nM30\n", setup), std::pair(0, 0U));
  EXPECT_EQ(refusal_of(head + "G42\nG00 Z-5\nG01 X0 F300\nX40\nG40 X60\nM30\n", setup),
            std::pair(0, 0U));
  EXPECT_EQ(refusal_of(head + "G18\n" + mill + "Z20\nG40 X60\nM30\n", setup), std::pair(0, 0U));
  EXPECT_EQ(refusal_of(head + mill + "X50\nG40 X60\nM30\n", setup), std::pair(900018, 6U));
  EXPECT_EQ(refusal_of(head + "G96 S200\nG18\n" + mill + "Z20\nG40 X60\nM30\n", setup),
            std::pair(900018, 5U));
  EXPECT_EQ(refusal_of(head + "G00 Y0\nT0202\n" + mill + "X50\nG40 X60\nM30\n", setup),
            std::pair(0, 0U));
}

// An axis that turns the part has been named before the contour.
TEST(AnAxisC, MayStandInAContour) {
  EXPECT_EQ(refusal_of(at_start + "G0 C90.\nG41 D1 G1 X0 Y0 F200\nY40. C5.\nG40 X-20.\nM30\n",
                       computing_setup(fanuc, 2)),
            std::pair(0, 0U));
}

TEST(AnOrientation, OfTheToolPassesWhileTrcIsOff) {
  const std::string text = "G71 G90\nORIC\nORID\nG0 X0 Y0\nM30\n";
  EXPECT_EQ(flat_of(text, computing_setup(sinumerik, 2)), text);
}

TEST(AFaultBeforeTheEnd, LeavesTheTextAfterItAlone) {
  const ProgramRun ran =
      to_text("O1\nG21 G90\nM198 P2000\nM30\nO2000\nG1 X0\nM99\n", computing_setup(fanuc, 2));
  ASSERT_EQ(ran.diagnostics.size(), 1U) << ran.report();
  EXPECT_EQ(ran.diagnostics.front().detail, "M198, a subprogram call");
}

// G69 beside G40: the axes of the line say where the tool goes (D-142).
TEST(AMotionThatIsCopied, LeavesTheContourBesideG69) {
  const ProgramRun ran =
      to_text(at_start +
                  "G68 X0 Y0 R30.\nG0 X-10. Y-10.\nG41 D1 G1 X0 Y0 F200\nY40.\nX40.\n"
                  "G69 G40 X70. Y40.\nM30\n",
              computing_setup(fanuc, 2));
  EXPECT_FALSE(ran.stopped) << ran.report();
  EXPECT_TRUE(ran.diagnostics.empty()) << ran.report();
}

// Blocks of Klartext have numbers without N.
TEST(BlocksOfKlartext, HaveNumbersWithoutN) {
  const ProgramRun ran = to_text(
      "0 BEGIN PGM A MM\n1 L X-20 Y+0 R0 FMAX\n2 CYCL DEF 7.0 NULLPUNKT\n3 CYCL DEF 7.1 X+5\n"
      "4 CC X+0 Y+0\n5 C X+20 Y+0 DR+\n6 END PGM A MM\n",
      computing_setup(heidenhain, 2));
  ASSERT_FALSE(ran.diagnostics.empty());
  EXPECT_NE(message_of(ran.diagnostics.front()).find("line 4 (block 3)"), std::string::npos)
      << message_of(ran.diagnostics.front());
}

// A second `%` ends the text of a tape, though no M30 stands before it.
TEST(AContourBehindTheTape, NamesThePercentSign) {
  const std::string contour = "G41 D1 G1 X5 Y5 F100\nX20\nY20\nG40 X0 Y0\nM30\n";
  const auto told = [](const std::string& text, DialectName dialect) {
    const ProgramRun ran = to_text(text, computing_setup(dialect, 2));
    return ran.diagnostics.empty() ? Diagnostic{} : ran.diagnostics.front();
  };
  for (const std::string computing : {"", "#1=0\n"})
    for (const DialectName dialect : {fanuc, linuxcnc}) {
      const std::string program = "G21 G90 G17\nG0 X0 Y0\n" + computing;
      const Diagnostic found = told("%\n" + program + "% B\n" + contour, dialect);
      const std::string line = computing.empty() ? "4" : "5";
      EXPECT_EQ(found.code, Code::side_behind_end);
      EXPECT_TRUE(found.detail.ends_with("after the % in line " + line)) << found.detail;
      EXPECT_NE(help_of(found).find("take the line with the % out"), std::string::npos)
          << help_of(found);
      EXPECT_NE(help_of(found, Language::german), help_of(found));
      const Diagnostic by_end = told("%\n" + program + "M30\n% B\n" + contour, dialect);
      EXPECT_EQ(by_end.detail.find('%'), std::string::npos) << by_end.detail;
    }
  for (const std::string computing : {"", "R1=0\n"}) {
    const Diagnostic found =
        told("%_N_A_MPF\nG90 G17\nG0 X0 Y0\n" + computing + "%_N_B_MPF\n" + contour, sinumerik);
    EXPECT_EQ(found.code, Code::side_behind_end);
    EXPECT_NE(found.detail.find("after the % in line "), std::string::npos) << found.detail;
  }
}

// The rest of the line belongs to the sign: a name of Okuma, or a comment of another control.
TEST(AForeignSign, IsOneErrorWithTheRestOfItsLine) {
  for (const std::string line : {"$EXAMPLE.MIN%", "' ROUGHING OF THE POCKET", "G0 X5. 'PARK HERE",
                                 "\"ROUGH OUT\"", "G0 X5. \"TEXT WITH X5 Y"})
    for (const DialectName dialect : {fanuc, linuxcnc}) {
      const ProgramRun ran =
          to_text("G21 G90 G17\n" + line + "\nG0 X0. Y0.\nM30\n", computing_setup(dialect, 2));
      ASSERT_EQ(ran.diagnostics.size(), 1U) << ran.report();
      EXPECT_EQ(ran.diagnostics.front().code, Code::nc_syntax) << ran.report();
      EXPECT_EQ(ran.diagnostics.front().source.line, 2U);
    }
}

}  // namespace
}  // namespace trc::support
