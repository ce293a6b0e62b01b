#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/programs/computing.h"

// Calls of subprograms that only the machine has, such as the macros of a probe, pass while TRC is
// off. Whatever they may have changed is unknown after them (D-64).

namespace trc::support::machine_calls {
namespace {

std::string flat(const std::string& text, DialectName dialect) {
  return flat_of(text, computing_setup(dialect));
}

std::pair<int, unsigned> refused(const std::string& text, DialectName dialect) {
  return refusal_of(text, computing_setup(dialect));
}

constexpr DialectName fanuc = DialectName::fanuc;
constexpr DialectName sinumerik = DialectName::sinumerik;
const std::string contour = "G41 D1 G1 X0 Y0 F300.\nY40.\nG40 X-20.\nM30\n";
const std::string contour_of_edge = "G41 G1 X0 Y0 F300\nY40\nG40 X-20\nM30\n";

TEST(MachineCalls, OfFanucPassWithTheirValues) {
  const std::string probing =
      "G21 G90 G17\nN5 G65 P9810 Z10. F3000. (SAFE)\nG65 P9811 X[1+2] A1. I5. I6. W1.\n"
      "M98 P8000\nM98 P9023 L2\nM30\n";
  std::string written = probing;
  written.replace(written.find("[1+2]"), 5, "3.");
  EXPECT_EQ(flat(probing, fanuc), written);
  EXPECT_EQ(flat("G90 G0 X0 Y0 M98 P9001\nN7 #1=9001\nN8 M98 P#1 L2 (A)\nM30\n", fanuc),
            "G90 G0 X0 Y0\nM98 P9001\n#1=9001.\nN8 M98 P9001 L2\nM30\n");
}

// They may read the variables that the program has set: these are set before them, once.
TEST(MachineCalls, OfFanucFindTheVariablesOfTheProgram) {  // D-95
  EXPECT_EQ(flat("G90 G0 X0 Y0\n#1=2\n#501=25/2 (LENGTH)\n#502=-#501\n#503=#0\nM98 P9100 (READS)\n"
                 "G65 P9101 A2.\n#502=7\nG65 P9102\nM30\n",
                 fanuc),
            "G90 G0 X0 Y0\n(LENGTH)\n#1=2.\n#501=12.5\n#502=-12.5\n#503=#0\nM98 P9100 (READS)\n"
            "G65 P9101 A2.\n#502=7.\nG65 P9102\nM30\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\nG66 P9100\n#501=3\nX1.\nY1.\nG67\nM30\n", fanuc),
            "G90 G0 X0 Y0\nG66 P9100\n#501=3.\nX1.\nY1.\nG67\nM30\n");
}

// Procedures of the language change neither modes nor position (D-174), and stay in a contour too.
TEST(MachineCalls, OfTheLanguageOfSinumerikLeaveModesAndPosition) {
  for (const std::string call :
       {"SETPIECE(1)", "GET(C)",           "RELEASE(C)",    "SOFTA(X)",      "BRISKA(X)",
        "DRIVEA(X)",   "JERKA(X)",         "SETM(1)",       "CLEARM(1)",     "CLEARM",
        "WAITE(2)",    "RESETMON(R1,1,1)", "GETSELT(R1,1)", "ENABLE(1)",     "DISABLE(1)",
        "CLRINT(1)",   "TRAILOF(Y,X)",     "TANGOF(C)",     "LOCK(1)",       "UNLOCK(1)",
        "CANCEL(1)",   "DELT(\"MILL\",1)", "CPROT(1,0)",    "TRAILON(C,X,1)"}) {
    const std::string head = "G90 G17 G71 G0 X-20 Y5\n";
    const std::string onward = "G91 G41 G1 X20 F300\nY40\nG90 G40 X-20\nM30\n";
    EXPECT_EQ(refused(head + call + "\n" + onward, sinumerik).first, 0) << call;
    EXPECT_EQ(
        refused(head + "G91 G41 G1 X20 F300\n" + call + "\nY40\nG90 G40 X-20\nM30\n", sinumerik)
            .first,
        0)
        << call;
  }
}

TEST(MachineCalls, OfTheLanguageOfSinumerikLoseTheAxesThatTheyName) {
  const std::string head = "G90 G17 G71 G0 X-20 Y5\n";
  const std::string onward = "G91 G41 G1 X20 F300\nY40\nG90 G40 X-20\nM30\n";
  for (const std::string call :
       {"PRESETON(X,0)", "PRESETON(X1,0)", "PRESETON(AX1,0)", "GET(X,C)", "TANGON(Y,0)"}) {
    EXPECT_EQ(refused(head + call + "\n" + onward, sinumerik), std::pair(900106, 3U)) << call;
    EXPECT_EQ(
        refused(head + "G41 G1 X0 Y0 F300\nY20\n" + call + "\nY40\nG40 X-20\nM30\n", sinumerik),
        std::pair(900003, 4U))
        << call;
  }
  const std::string led = head + "TRAILON(Y,X,1)\n";
  const std::string again = "G0 X-20 Y0\n" + contour_of_edge;
  EXPECT_EQ(refused(led + again, sinumerik), std::pair(900003, 4U));
  EXPECT_EQ(refused(led + "TRAILOF(X,Y)\n" + again, sinumerik), std::pair(900003, 5U));
  EXPECT_EQ(refused(led + "TRAILOF(Y,X)\n" + again, sinumerik).first, 0);
  EXPECT_EQ(refused(led + "TRAILOF(Y,X)\n" + onward, sinumerik), std::pair(900106, 4U));
}

// C=IC(90): the axis moves beside the path, and nobody follows it.
TEST(MachineCalls, StandBesideIncrementsOfFurtherAxes) {
  const std::string head = "G90 G17 G71 G0 X-20 Y0\n";
  for (const std::string word : {"C=IC(90)", "G0 C=IC(90)", "G1 A=IC(-5) F100", "G91 C=AC(9)"}) {
    const std::string text = head + word + "\nG90 G0 X-20 Y0\n" + contour_of_edge;
    EXPECT_EQ(refused(text, sinumerik).first, 0) << word;
    EXPECT_NE(flat(text, sinumerik).find("\n" + word + "\n"), std::string::npos) << word;
  }
  EXPECT_EQ(refused(head + "G41 G1 X0 Y0 C=IC(90) F300\nY40\nG40 X-20\nM30\n", sinumerik),
            std::pair(900003, 2U));
  EXPECT_EQ(refused(head + "G41 G1 X0 Y0 F300\nY40\nC=IC(90)\nX9\nG40 X-20\nM30\n", sinumerik),
            std::pair(900003, 4U));
}

// Variables of the machine builder are set as the program says; what they then hold only the
// machine knows (D-172).
TEST(MachineCalls, FindTheVariablesOfTheMachineThatTheProgramSets) {
  const std::string head = "G90 G17 G71 G0 X-20 Y0\n";
  const auto written = [&](const std::string& line) {
    const std::string text = flat(head + line + "\n" + contour_of_edge, sinumerik);
    return text.substr(head.size(), text.find('\n', head.size()) - head.size());
  };
  EXPECT_EQ(written("_OFFSET=5"), "_OFFSET=5");
  EXPECT_EQ(written("DRZ=170 DRR=3"), "DRZ=170 DRR=3");
  EXPECT_EQ(written("_ZSD[2]=1"), "_ZSD[2]=1");
  EXPECT_EQ(written("_PROG=\"ABC\""), "_PROG=\"ABC\"");
  EXPECT_EQ(written("R1=2 R2=3 _ZSD[R1]=R2*4 ; set"), "_ZSD[2]=12 ; set");
  EXPECT_EQ(refused(head + "_OFFSET=5\nR1=_OFFSET\nM30\n", sinumerik), std::pair(900303, 3U));
  EXPECT_EQ(
      refused(head + "_OFFSET=5\nG1 X=_OFFSET Y0 F100\nG91 G41 X5\nY9\nG40 X9\nM30\n", sinumerik),
      std::pair(900106, 4U));
  ProgramSessionSetup given = computing_setup(sinumerik);
  given.session.program.variables["_OFFSET"] = 7;
  EXPECT_EQ(refusal_of("R1=_OFFSET\n" + head + contour_of_edge, given).first, 0);
  EXPECT_EQ(refusal_of("_OFFSET=5\n" + head + "X=_OFFSET+1\n" + contour_of_edge, given),
            std::pair(900303, 3U));
  EXPECT_EQ(refused(head + "G41 G1 X0 Y0 F300\nY40\n_OFFSET=5\nX9\nG40 X-20\nM30\n", sinumerik),
            std::pair(900003, 4U));
  for (const std::string word : {"LEAD=0", "STAT=1", "DISPR=1"}) {
    EXPECT_EQ(refused(head + word + "\n" + contour_of_edge, sinumerik), std::pair(900003, 2U));
    given.session.program.pass_words = {word.substr(0, word.find('='))};
    EXPECT_EQ(refusal_of("R1=5\n" + head + word + "\n" + contour_of_edge, given).first, 0);
  }
}

TEST(MachineCalls, OfSinumerikKeepTheirDeclaration) {  // D-95
  EXPECT_EQ(flat("EXTERN TASCHE(REAL)\nG90 G0 X0 Y0\nR1=80\nTASCHE(R1)\nM30\n", sinumerik),
            "EXTERN TASCHE(REAL)\nG90 G0 X0 Y0\nR1=80\nTASCHE(80)\nM30\n");
}

// The flat program comes out as it is where it is read again.
void expect_flat(const std::string& text, const std::string& expected) {
  EXPECT_EQ(flat(text, sinumerik), expected);
  EXPECT_EQ(flat(expected, sinumerik), expected);
}

TEST(MachineCalls, OfSinumerikFindTheVariablesOfTheProgram) {  // D-95
  expect_flat(
      "R1=80 R[2]=R1/4 ; LENGTH\nG90 G0 X=R1 Y0\nEXTCALL(\"TASCHE\")\nR2=-7.5\nKONTUR()\n"
      "KONTUR()\nM30\n",
      "; LENGTH\nG90 G0 X=80 Y0\nR1=80\nR2=20\nEXTCALL(\"TASCHE\")\nR2=-7.5\nKONTUR()\n"
      "KONTUR()\nM30\n");
  expect_flat("G90 G0 X0 Y0\nMCALL BORE(5)\nR1=3\nX10\nMCALL\nR1=4\nX20\nL6\nM30\n",
              "G90 G0 X0 Y0\nMCALL BORE(5)\nR1=3\nX10\nMCALL\nX20\nR1=4\nL6\nM30\n");
  ProgramSessionSetup setup = computing_setup(sinumerik);
  setup.session.program.pass_words = {"BORE", "L77"};
  EXPECT_EQ(flat_of("G90 G0 X0 Y0\nR1=3\nBORE\nR1=4\nBORE(R1)\nR1=5\nL77\nM30\n", setup),
            "G90 G0 X0 Y0\nR1=3\nBORE\nR1=4\nBORE(R1)\nR1=5\nL77\nM30\n");
}

TEST(MachineCalls, OfSinumerikAreGivenVariables) {  // D-83
  expect_flat(
      "EXTERN WARMUP(REAL,VAR REAL)\nDEF REAL ERG=2, OTHER ; RESULT\nDEF INT ERR\n"
      "DEF REAL A\nG90 G0 X=ERG Y0\nA=80\nERG=A/2\nWARMUP(A,ERG)\n"
      "WRITE(ERR,\"LOG\",\"START\")\nERR=4\nWRITE(ERR,\"LOG\",\"END\")\nWARMUP(1,R7)\nM30\n",
      "EXTERN WARMUP(REAL,VAR REAL)\nDEF REAL ERG=2, OTHER ; RESULT\nDEF INT ERR\n"
      "G90 G0 X=2 Y0\nERG=40\nWARMUP(80,ERG)\nWRITE(ERR,\"LOG\",\"START\")\nERR=4\n"
      "WRITE(ERR,\"LOG\",\"END\")\nWARMUP(1,R7)\nM30\n");
  // Without EXTERN it is unknown how the subprogram takes its arguments.
  expect_flat("DEF REAL LIST[2,3]\nG90 G0 X0 Y0\nLIST[1,2]=5\nMEASURE(LIST,1+1)\nM30\n",
              "DEF REAL LIST[2,3]\nG90 G0 X0 Y0\nLIST[1,2]=5\nMEASURE(LIST,2)\nM30\n");
  const std::string asks = "DEF INT ERR\nWRITE(ERR,\"LOG\",\"A\")\nIF ERR==0\nG0 X1\nENDIF\nM30\n";
  EXPECT_EQ(refused(asks, sinumerik), std::pair(900303, 3U));
  ProgramSessionSetup setup = computing_setup(sinumerik);
  setup.session.program.variables = {{"ERR", 0}};
  EXPECT_EQ(flat_of(asks, setup), "DEF INT ERR\nWRITE(ERR,\"LOG\",\"A\")\nG0 X1\nM30\n");
  // DEF of a subprogram stands after the first motion of the flat program.
  EXPECT_EQ(refused("G0 X1\nLOGS\nM30\n%_N_LOGS_SPF\nDEF INT ERR\nWRITE(ERR,\"LOG\",\"A\")\nM17\n",
                    sinumerik),
            std::pair(900003, 6U));
}

// What they have in a contour they have there.
TEST(MachineCalls, OfSinumerikMayWriteInAContour) {
  const std::string text = flat(
      "DEF INT ERR\nG17 G90 G71\nG0 X-20 Y0 Z1\nG41 G1 X0 Y0 F300\nERR=1\n"
      "WRITE(ERR,\"LOG\",\"A\")\nY40\nG40 X-20\nM30\n",
      sinumerik);
  EXPECT_NE(text.find("\nERR=1\nWRITE(ERR,\"LOG\",\"A\")\n"), std::string::npos) << text;
}

TEST(MachineCalls, AreNoCallsOfPrograms) {
  EXPECT_EQ(refused("G90 G17\nM98 P1000\nM30\n", fanuc), std::pair(900306, 2U));
  EXPECT_EQ(refused("G90 G17\nG65 P7999 A1.\nM30\n", fanuc), std::pair(900306, 2U));
  ProgramSessionSetup setup = computing_setup(fanuc);
  setup.session.program.pass_words = {"O1000"};
  const std::string text = "G90 G17\nM98 P1000\nM30\n";
  EXPECT_EQ(flat_of(text, setup), text);
  // What is there is executed, whatever its number.
  EXPECT_EQ(flat("M98 P9001\nM30\nO9001\nG0 X1.\nM99\n", fanuc), "(O9001)\nG0 X1.\nM30\n");
}

TEST(MachineCalls, ForgetWhereTheToolIs) {
  EXPECT_EQ(refused("G21 G90 G17\nG0 X-20. Y0\nG65 P9810 Z10.\n" + contour, fanuc),
            std::pair(900106, 4U));
  // G90 and a motion function hold anew, and the place is known.
  EXPECT_EQ(refused("G21 G90 G17\nG0 X-20. Y0\nG65 P9810 Z10.\nX-20. Y0\n" + contour, fanuc),
            std::pair(900106, 5U));
  EXPECT_EQ(refused("G21 G90 G17\nG0 X-20. Y0\nG65 P9810 Z10.\nG92 X-20. Y0 Z0\n" + contour, fanuc),
            std::pair(900106, 5U));
  EXPECT_EQ(
      refused("G21 G90 G17\nG0 X-20. Y0\nG65 P9810 Z10.\nG90 G0 X-20. Y0 Z1.\n" + contour, fanuc),
      std::pair(0, 0U));
}

TEST(MachineCalls, DoNotPassWithinAContour) {
  const std::string within = "G21 G90 G17\nG0 X-20. Y0 Z1.\nG41 D1 G1 X0 Y0 F300.\nY40.\n";
  EXPECT_EQ(refused(within + "G65 P9810 Z10.\nG40 X-20.\nM30\n", fanuc), std::pair(900003, 5U));
  EXPECT_EQ(refused(within + "M98 P9001\nG40 X-20.\nM30\n", fanuc), std::pair(900003, 5U));
}

// G66 has its macro after each line that moves: such a line is read as any other, but where it
// leads to only the machine knows.
TEST(MachineCalls, ModalOnesLetNoContourBegin) {  // D-68
  const std::string modal = "G21 G90 G17\nG0 X-20. Y0 Z1.\nG66 P9001\n";
  EXPECT_EQ(refused(modal + contour, fanuc), std::pair(900003, 4U));
  EXPECT_EQ(refused(modal + "G41 D1\nG1 X0 Y0 F300.\nY40.\nG40 X-20.\nM30\n", fanuc),
            std::pair(900003, 5U));
  EXPECT_EQ(refused(modal + "G90 G0\nX5. Y5.\nG67\n" + contour, fanuc), std::pair(900106, 7U));
  EXPECT_EQ(refused(modal + "G0 X5. Y5.\nG67\nG90 G0 X-20. Y0 Z1.\n" + contour, fanuc),
            std::pair(0, 0U));
  // Its feed holds after it as well.
  EXPECT_EQ(refused(modal + "G1 X5. F250.\nG67\nG90 G1 X-20. Y0 Z1.\n"
                            "G41 D1 G1 X0 Y0\nY40.\nG40 X-20.\nM30\n",
                    fanuc),
            std::pair(0, 0U));
}

TEST(MachineCalls, AreToldByWholeCharacters) {
  ProgramSession session(computing_setup(fanuc));
  Answers answers;
  EXPECT_FALSE(session.feed("G21 G90 G17\nG0 X-20. Y0 Z1.\nG41 D1 G1 X0 Y0 F300.\nG66 P9811\n"
                            "N10\xC2\xA0G65 P9812\nM30\n",
                            answers) &&
               session.finish(answers));
  const std::vector<Diagnostic> told = answers.take().diagnostics;
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1].detail.substr(0, 10), "G65 P9812,") << told[1].detail;
}

TEST(MachineCalls, ForgetWhatTheyMaySet) {
  EXPECT_EQ(refused("#1=5\n#100=5\nG65 P9810 Z1.\nG90 G0 X#1\nG90 G0 X#100\nM30\n", fanuc),
            std::pair(900303, 5U));
  EXPECT_EQ(refused("#1=5\nM98 P9810\nG90 G0 X#1\nM30\n", fanuc), std::pair(900303, 3U));
  EXPECT_EQ(flat("#1=5\nM98 P9810\n#1=6\n#100=7\nG90 G0 X#1 Y#100\nM30\n", fanuc),
            "#1=5.\nM98 P9810\nG90 G0 X6. Y7.\nM30\n");
  EXPECT_EQ(refused("M98 P9810\nIF [#135 GT 0.1] GOTO 5\nN5 M30\n", fanuc), std::pair(900303, 2U));
}

TEST(MachineCalls, OfSinumerikPass) {
  const std::string text =
      "G17 G90 G71\nTOOLCHECK()\nN5 PROBE_Z(1, \"A\",, 2.5) ; Z\nG90 G0 X-20 Y0 Z1\n";
  EXPECT_EQ(flat(text + "M30\n", sinumerik), text + "M30\n");
  EXPECT_EQ(flat("DEF REAL DEPTH=5\nCHECK_IT(DEPTH, 2*R1)\nM30\n", sinumerik).substr(0, 9),
            "2: 900303");
  EXPECT_EQ(flat("DEF REAL DEPTH=5\nR1=2\nCHECK_IT(1+1, 2*R1)\nM30\n", sinumerik),
            "R1=2\nCHECK_IT(2, 4)\nM30\n");
  EXPECT_EQ(refused("G17 G90 G71\nG0 X-20 Y0 Z1\nTOOLCHECK()\n" + contour_of_edge, sinumerik),
            std::pair(900106, 4U));
  EXPECT_EQ(refused(text + contour_of_edge, sinumerik), std::pair(0, 0U));
  EXPECT_EQ(refused(text + "G41 G1 X0 Y0 F300\nTOOLCHECK()\nG40 X-20\nM30\n", sinumerik),
            std::pair(900003, 6U));
}

TEST(MachineCalls, OfLinuxcncPassWhereTheyAreDeclared) {  // D-77
  ProgramSessionSetup setup = computing_setup(DialectName::linuxcnc);
  const std::string call = "#1=2 #40=7 #<_depth>=3\no<Probe> call [#1+1] [4] (corner)\n";
  EXPECT_EQ(refusal_of(call + "M2\n", setup), std::pair(900306, 2U));
  setup.session.program.pass_words = {"PROBE"};
  EXPECT_EQ(flat_of(call + "G90 G0 X#1\nM2\n", setup),
            "#40=7\n#<_depth>=3\no<Probe> call [3] [4] (corner)\nG90 G0 X2\nM2\n");
  const std::string plain = "G21 G90\nN5 o<probe> call\nG90 G0 X2\nM2\n";
  EXPECT_EQ(flat_of(plain, setup), plain);
  EXPECT_EQ(refusal_of(call + "G90 G0 X#40\nM2\n", setup), std::pair(900303, 3U));
  EXPECT_EQ(refusal_of(call + "G90 G0 X#<_depth>\nM2\n", setup), std::pair(900303, 3U));
  EXPECT_EQ(refusal_of(call + "G0 X-20 Y0\n" + "G41 G1 X0 F300\nY40\nG40 X-20\nM2\n", setup),
            std::pair(900106, 4U));
}

// L6 is the change of tools as Siemens delivers it, other numbers may be of a builder: subprograms
// that only the machine has.
TEST(MachineCalls, OfSinumerikByNumberPassWhereTheyAreDeclared) {
  ProgramSessionSetup setup = computing_setup(sinumerik);
  const std::string other = "G17 G90 G71\nN20 T1\nN30 L106 ; change\nG90 G0 X-20 Y0 Z1\n";
  EXPECT_EQ(refusal_of(other + "M30\n", setup), std::pair(900306, 3U));
  setup.session.program.pass_words = {"L106"};
  EXPECT_EQ(flat_of(other + "M30\n", setup), other + "M30\n");
  setup.session.program.pass_words = {};
  const std::string text = "G17 G90 G71\nN20 T1 D1\nN30 L6 ; change\nG90 G0 X-20 Y0 Z1\n";
  EXPECT_EQ(flat_of(text + "M30\n", setup), text + "M30\n");
  EXPECT_EQ(refusal_of("G17 G90 G71\nL06\nM30\n", setup), std::pair(900306, 2U));
  setup.session.program.subprograms = {{"L6.SPF", "G0 X1\nM17\n"}};
  EXPECT_EQ(flat_of("L6\nM30\n", setup), "; L6\nG0 X1\nM30\n");
  setup.session.program.subprograms = {};
  EXPECT_EQ(refusal_of(text + contour_of_edge, setup), std::pair(0, 0U));
  EXPECT_EQ(refusal_of("G17 G90 G71\nR1=5\nL6\nG90 G0 X=R1\nM30\n", setup), std::pair(900303, 4U));
  EXPECT_EQ(refusal_of("G17 G90 G71\nG0 X-20 Y0\nL6\nG0 X-20 Y0\n" + contour_of_edge, setup),
            std::pair(900106, 5U));
}

std::string written(const std::string& text, DialectName dialect, double radius) {
  ProgramSessionSetup setup = computing_setup(dialect);
  setup.session.program.tools.clear();
  setup.session.program.mode.tool_radius = radius;
  return flat_of(text, setup);
}

// A subprogram of the machine may hold a contour: it finds the modes of TRC that the program has
// set, although nothing of them comes out elsewhere.
TEST(MachineCalls, FindTheModesOfTrc) {  // D-69
  const std::string head = "N10 G90 G17 G26 G138\n#TRC [REMOVE_MASKED_BLOCKS=1]\nN20 G00 X0 Y0\n";
  EXPECT_EQ(written(head + "N25 G25\nV.G.WZ_AKT.R=5\nL CONTOUR.SUB\nL CONTOUR.SUB\nM30\n",
                    DialectName::isg, 5),
            "N10 G90 G17\nN20 G00 X0 Y0\nG138 G25\n#TRC [REMOVE_MASKED_BLOCKS=1]\n"
            "V.G.WZ_AKT.R=5\nL CONTOUR.SUB\nL CONTOUR.SUB\nM30\n");
  EXPECT_EQ(written("G17 G90 G71 G451\nOFFN=0.5\nG0 X0 Y0\nKONTUR(1)\nM30\n", sinumerik, 5),
            "G17 G90 G71 G451\nG0 X0 Y0\nOFFN=0.5\nKONTUR(1)\nM30\n");
}

TEST(MachineCalls, OfSinumerikForgetWhatTheyMaySet) {
  EXPECT_EQ(refused("R1=5\nTOOLCHECK()\nG90 G0 X=R1\nM30\n", sinumerik), std::pair(900303, 3U));
  EXPECT_EQ(flat("DEF REAL A1=5\nTOOLCHECK()\nG90 G0 X=A1\nM30\n", sinumerik),
            "TOOLCHECK()\nG90 G0 X=5\nM30\n");
  EXPECT_EQ(refused("DEF REAL A1=5\nTOOLCHECK(A1)\nG90 G0 X=A1\nM30\n", sinumerik),
            std::pair(900303, 3U));
}

}  // namespace
}  // namespace trc::support::machine_calls
