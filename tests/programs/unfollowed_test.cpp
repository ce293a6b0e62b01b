#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/programs/computing.h"

// Under scaling, polar coordinates, transformations and the like no contour is compensated. Each
// lasts up to an end of its own: the end of another one leaves it in force.

namespace trc::support {
namespace {

using enum DialectName;

std::string contour_behind(DialectName dialect, const std::string& text) {
  const bool fanuc_words = dialect == fanuc;
  const std::string head = fanuc_words ? "G21 G17 G90 G40 G54\nT1 M6\nG0 X0. Y0.\n"
                                       : "G71 G17 G90 G40 G54\nT1 D1\nG0 X0 Y0\n";
  const std::string contour = fanuc_words
                                  ? "G0 X-20. Y0. Z5.\nG1 Z-2. F300.\nG41 D1 X0. F500.\nY40.\nG40 "
                                    "X-20.\nM30\n"
                                  : "G0 X-20 Y0 Z5\nG1 Z-2 F300\nG41 X0 F500\nY40\nG40 X-20\nM30\n";
  return head + text + "\n" + contour;
}

std::pair<int, unsigned> of_contour(DialectName dialect, const std::string& text) {
  return refusal_of(contour_behind(dialect, text), setup_with_tool(dialect));
}

// A rounding or a chamfer of ISG cuts a corner of lines that are copied, and leaves their ends. In
// a contour, and before one, it is refused (D-173).
TEST(Unfollowed, AreCornersOfIsg) {
  const std::string head = "G71 G17 G90 D1\nG00 X0 Y0\nG01 X50 F500\n";
  const std::string contour = "G41 G01 X0 Y0\nY40\nG40 X-20\nM30\n";
  for (const std::string corner : {"G302 I5\nG01 Y50\n", "G301 I5 F200\nY50\n", "#RND=5\nY50\n",
                                   "X60 #CHR=5\nY50\n", "G302 I5 #FRC=100\nY50\n"}) {
    const std::string lines = head + corner + "G91 X-50\nG90\n";
    EXPECT_EQ(refusal_of(lines + contour, setup_with_tool(isg)).first, 0) << corner;
    EXPECT_EQ(flat_of(lines + "M30\n", setup_with_tool(isg)), lines + "M30\n");
    EXPECT_EQ(refusal_of(head + "Y0\n" + corner.substr(0, corner.find('\n') + 1) + contour,
                         setup_with_tool(isg)),
              std::pair(900003, 5U))
        << corner;
  }
  EXPECT_EQ(refusal_of(head + "G302 I5 X9\nM30\n", setup_with_tool(isg)), std::pair(900003, 4U));
  for (const std::string corner : {"G302 I5", "#RND=5", "X20 #CHR=5", "#CONTOUR BEGIN[ID=1]",
                                   "#ROTATION ON [ANGLE=30]", "#OTC ON"})
    EXPECT_EQ(refusal_of(head + "G41 X0 Y0\nY40\n" + corner + "\nX20\nG40 X-20\nM30\n",
                         setup_with_tool(isg)),
              std::pair(900003, 6U))
        << corner;
}

// The contour of a cycle is described, not travelled (D-173).
TEST(Unfollowed, IsTheContourOfACycleOfIsg) {
  const std::string head = "G71 G17 G90 D1\nG00 X-20 Y0\n#CONTOUR BEGIN[ID=1]\n";
  const std::string lines = "G01 X25 Y25 F500\nG302 I5\nG02 X30 Y20 R5\n";
  const std::string contour = "G41 G01 X0 Y0\nY40\nG40 X-20\nM30\n";
  const auto refused = [&](const std::string& text) {
    return refusal_of(text, setup_with_tool(isg));
  };
  EXPECT_EQ(refused(head + lines + "#CONTOUR END\nG00 X-20 Y0\n" + contour).first, 0);
  EXPECT_EQ(refused(head + lines + "#CONTOUR END\nG91 X5\nG90\n" + contour).first, 900106);
  EXPECT_EQ(refused(head + lines + contour), std::pair(900003, 7U));
  EXPECT_EQ(refused(head + "G41\n" + lines + "#CONTOUR END\n" + contour).first, 900003);
}

TEST(Unfollowed, LastsUpToItsOwnEndInFanuc) {  // D-112
  using Ends = std::vector<std::string>;
  const std::vector<std::pair<std::string, Ends>> modes{
      {"G51 X0 Y0 P2.", {"G50"}},    {"G16", {"G15"}},
      {"G12.1", {"G13.1"}},          {"G43.4 H1", {"G49", "G43 H1 Z50."}},
      {"G07.1 C25.", {"G07.1 C0."}}, {"G72 S0.5", {"G72 S1"}},
      {"G107 A0 Y0 R20.", {"G107"}}, {"G54.4 P1", {"G54.4 P0"}},
      {"G143 H1", {"G49"}},
  };
  for (const auto& [mode, own_ends] : modes)
    for (const auto& [other, ends] : modes)
      for (const std::string& end : ends) {
        const bool is_its_end = mode == other || (mode == "G143 H1" && other == "G43.4 H1") ||
                                (mode == "G43.4 H1" && other == "G143 H1");
        EXPECT_EQ(of_contour(fanuc, mode + "\n" + end).first, is_its_end ? 0 : 900003)
            << mode << ' ' << end;
      }
  // What it is stands there in both languages.
  for (const std::string mode : {"G43.1 H1", "G43.5 H1", "G234 H1", "G112"})
    EXPECT_TRUE(to_text(contour_behind(fanuc, mode), setup_with_tool(fanuc)).stopped) << mode;
  for (const auto& [mode, own_ends] : modes)
    EXPECT_TRUE(to_text(contour_behind(fanuc, mode), setup_with_tool(fanuc)).stopped) << mode;
  // Two functions in one line, in either order, and one within the other.
  EXPECT_EQ(of_contour(fanuc, "G51 X0 Y0 P2.\nG16\nG15 G50").first, 0);
  EXPECT_EQ(of_contour(fanuc, "G51 X0 Y0 P2.\nG16\nG50 G15").first, 0);
  EXPECT_EQ(of_contour(fanuc, "G51 X0 Y0 P2.\nG16\nG15").first, 900003);
  EXPECT_EQ(of_contour(fanuc, "G51 X0 Y0 P2.\nG16\nG50").first, 900003);
}

TEST(Unfollowed, LastsUpToItsOwnEndInSinumerik) {  // D-112
  const std::string scaled_offset = "$P_UIFR[1]=CTRANS(X,5):CSCALE(X,2,Y,2)\nG54";
  const std::string scaled_frame = "$P_PFRAME=CSCALE(X,2,Y,2)";
  for (const std::string& mode :
       {std::string("SCALE X2 Y2"), std::string("ASCALE X2 Y2"), scaled_frame}) {
    for (const std::string end : {"TRANS", "ROT", "MIRROR", "SCALE", "TRANS X10 Y5",
                                  "$P_PFRAME=CTRANS(X,10)", "$P_PFRAME=CTRANS()"})
      EXPECT_EQ(of_contour(sinumerik, mode + "\n" + end).first, 0) << mode << ' ' << end;
    for (const std::string other :
         {"TRAFOOF", "ATRANS X5", "TRAORI\nTRAFOOF", "CUT2D", "$P_PFRAME=$P_PFRAME:CTRANS(X,1)",
          "$P_PFRAME[X,TR]=5", "$P_UIFR[1]=CTRANS(X,5)", "ASCALE X3", "G500"})
      EXPECT_EQ(of_contour(sinumerik, mode + "\n" + other).first, 900003) << mode << ' ' << other;
  }
  for (const std::string other : {"TRANS", "SCALE", "SCALE X1\nSCALE", "SCALE X2\nTRANS", "TRAFOOF",
                                  "$P_PFRAME=CTRANS()", "$P_UIFR[2]=CTRANS(X,5)"})
    EXPECT_EQ(of_contour(sinumerik, scaled_offset + "\n" + other).first, 900003) << other;
  EXPECT_EQ(of_contour(sinumerik, scaled_offset + "\n$P_UIFR[1]=CTRANS(X,5)\nG54").first, 0);
  EXPECT_EQ(of_contour(sinumerik, "TRAORI\nSCALE X2\nSCALE").first, 900003);
  EXPECT_EQ(of_contour(sinumerik, "TRAORI\nTRANS").first, 900003);
  EXPECT_EQ(of_contour(sinumerik, "TRAORI\nTRAFOOF").first, 0);
}

// After the end of a rotation a mirrored axis stands where the mirror is: its own end moves it.
TEST(Unfollowed, RotationAndMirrorEndEachForItself) {
  const auto ends_open = [](const std::string& text) {
    return of_contour(fanuc, text + "\nG91\nG0 X5.\nG90").first;
  };
  EXPECT_EQ(ends_open("G51.1 X0\nG69\nG0 X10. Y10."), 0);
  EXPECT_EQ(ends_open("G51.1 X0\nG69\nG0 X10. Y10.\nG50.1 X0"), 900106);
  EXPECT_EQ(ends_open("G68 X0 Y0 R30.\nG50.1 X0\nG0 X10. Y10.\nG69"), 900106);
  EXPECT_EQ(ends_open("G68 X0 Y0 R30.\nG0 X10. Y10.\nG69 G50.1 X0"), 900106);
}

// The axes of G50.1 and of a pole are no way to the contour, and a call of the machine has words of
// its own: G41 would come out beside them, and the control compensate once more.
TEST(Unfollowed, SelectionBesideWhatIsNoMotion) {
  const auto code_of = [](DialectName dialect, const std::string& selection) {
    const std::string end = "\nG1 Y40.\nG40 X-20. Y-20.\nM30\n";
    const std::string begin = "G90 G17\nG0 X-20. Y-20. Z5.\nG1 Z-2. F300.\n";
    return refusal_of(begin + selection + end, computing_setup(dialect, 5)).first;
  };
  for (const std::string beside : {"G50.1", "G100", "G65 P9100", "G66 P9100"}) {
    EXPECT_EQ(code_of(fanuc, "G41 D1 G1 X0. Y-10. " + beside), 900003) << beside;
    EXPECT_EQ(code_of(fanuc, beside + " G42 D1 X0. Y-10."), 900003) << beside;
  }
  EXPECT_EQ(code_of(fanuc, "G41 D1 G1 X0. Y-10. G50.2"), 0);
  for (const std::string pole : {"G110", "G111", "G112"})
    EXPECT_EQ(code_of(sinumerik, "G41 G1 X0 Y-10 " + pole), 900003) << pole;
}

// PathPilot heads its programs with G50; Mach goes to the reference point with G28.1, where grbl
// stores one: after both the axes that are named stand where only the control knows.
TEST(Unfollowed, WordsOfControlsOfTheSameFamilyComeOutAsTheyStand) {
  const auto text_of = [](DialectName dialect, const std::string& text) {
    return to_text(text, computing_setup(dialect, 5)).text;
  };
  const std::string head = "G17 G90 G40 G49 G50 G80\nG0 X1 Y2\nM2\n";
  EXPECT_EQ(text_of(linuxcnc, head), head);
  const std::string contour = "G41 D1 G1 X0. Y0. F500.\nY40.\nG40 X-20. Y-20.\nM30\n";
  for (const std::string reference : {"G28.1 X0. Y0.", "G30.1 X0. Y0."}) {
    const std::string text = "G90 G17\nG0 X-20. Y-20.\n" + reference + "\n";
    EXPECT_EQ(text_of(fanuc, text + "M30\n"), text + "M30\n");
    EXPECT_EQ(refusal_of(text + "G91\nG0 X1. Y1.\n", computing_setup(fanuc, 5)),
              std::pair(900106, 5U))
        << reference;
    EXPECT_EQ(refusal_of(text + "G0 X-20. Y-20.\n" + contour, computing_setup(fanuc, 5)).first, 0)
        << reference;
  }
}

struct Beside {
  DialectName dialect = fanuc;
  std::string line{};
  std::string name{};  // how it is told within a contour
  bool loses = true;   // where the tool stands
};

// Threads, measuring and axes that move by themselves come out as they stand where TRC is off.
// Where they end in the plane only the control knows, and no contour has them.
TEST(Unfollowed, MotionsOfOtherTasksComeOutAsTheyStand) {  // D-117
  const std::string begin = "G90 G17\nG0 X-20. Y-20. Z5.\n";
  const std::string contour = "G41 D1 G1 X0. Y0. F500.\nY40.\n";
  for (const Beside& each : {
           Beside{fanuc, "G33 X0. F1.5", "G33, thread cutting"},
           Beside{fanuc, "G33 Z-10. F1.5", "G33, thread cutting", false},
           Beside{sinumerik, "G33 Z-10 K1.5", "G33, thread cutting", false},
           Beside{sinumerik, "G34 Y-10 K1.5 F0.1", "G34, thread cutting"},
           Beside{sinumerik, "MEAS=1 G1 X10 F100", "MEAS=1, measuring"},
           Beside{sinumerik, "MEAW=-1 G1 Z-10 F100", "MEAW=-1, measuring", false},
           Beside{sinumerik, "POS[Z]=10", "POS[Z]=10, a motion of an axis by itself", false},
           Beside{sinumerik, "POSA[X]=10 FA[X]=100", "POSA[X]=10, a motion of an axis by itself"},
           Beside{fanuc, "G0 X-20. Y-20. R3.", "R in a straight motion", false},
           Beside{fanuc, "G1 X-20. Y-20. I0. J0. K0. F100.", "", false},
           Beside{fanuc, "G1 X0. I2. F100.", ""},
           Beside{fanuc, "G1 X0. R2. F100.", "R in a straight motion"},
           Beside{fanuc, "G10.6 X30.", "G10.6, retract", false},
           Beside{fanuc, "G102 X1. Y1.", "G102, output of positions", false},
       }) {
    const ProgramSessionSetup setup = computing_setup(each.dialect, 5);
    const std::string text = begin + each.line + "\nG0 Z5.\n";
    EXPECT_EQ(to_text(text + "M30\n", setup).text, text + "M30\n");
    const std::string end = "G40 X-20. Y-20.\nM30\n";
    EXPECT_EQ(refusal_of(text + "G91\nG0 X1. Y1.\n", setup).first, each.loses ? 900106 : 0)
        << each.line;
    EXPECT_EQ(refusal_of(text + "G0 X-20. Y-20.\n" + contour + end, setup).first, 0) << each.line;
    const ProgramRun within = to_text(begin + contour + each.line + "\n" + end, setup);
    ASSERT_TRUE(within.stopped) << each.line;
    EXPECT_NE(within.report().find(each.name), std::string::npos) << within.report();
  }
}

// A contour without G01 after a thread would be cut in step with the spindle.
TEST(Unfollowed, ThreadsAndProbingLastUpToTheNextMotionFunction) {  // D-117
  const std::string begin = "G90 G17\nG0 X-20. Y-20. Z5.\n";
  const std::string end = "Y40.\nG40 X-20. Y-20.\nM30\n";
  using Motions = std::vector<std::pair<DialectName, std::string>>;
  for (const auto& [dialect, motion] : Motions{{fanuc, "G33 Z-1. F1."},
                                               {sinumerik, "G33 Z-1 K1"},
                                               {sinumerik, "G331 Z-1 K1"},
                                               {linuxcnc, "G33.1 Z-1 K1"},
                                               {linuxcnc, "G38.2 Z-1 F100"}}) {
    const ProgramSessionSetup setup = computing_setup(dialect, 5);
    const std::string at = begin + motion + "\n";
    EXPECT_EQ(refusal_of(at + "G41 D1 X0. Y0. F500.\n" + end, setup).first, 900003) << motion;
    EXPECT_EQ(refusal_of(at + "G41 D1 G1 X0. Y0. F500.\n" + end, setup).first, 0) << motion;
    EXPECT_EQ(refusal_of(at + "X0.\nG91 G0 X5.\nG90\nM30\n", setup).first, 900106) << motion;
  }
}

// Where the tool stands after a change of tools only the control knows: no contour hangs on it
// (D-127).
TEST(Unfollowed, IsAnIncrementFromAHeightThatIsNotKnown) {
  for (const DialectName dialect : {fanuc, linuxcnc}) {
    const std::string text =
        "G21 G90 G17\nT1 M6\nG91 G0 X-10. Z-5.\nG90 G0 X-20. Y0. Z2.\nG41 D1 G1 X0. F100.\n"
        "Y40.\nG40 X-20.\nM30\n";
    EXPECT_EQ(refusal_of(text, setup_with_tool(dialect)).first, 0)
        << to_text(text, setup_with_tool(dialect)).report();
    const std::string counted = "G21 G90 G17\nT1 M6\nG91 G0 X-10. Z-5.\nX5.\nG90\nM30\n";
    EXPECT_EQ(refusal_of(counted, setup_with_tool(dialect)), std::pair(900106, 4U));
  }
}

// Each axis by what changed it last.
TEST(Unfollowed, IsToldByTheChangeOfItsOwnAxis) {
  const std::string text =
      "G21 G90 G17\nG0 X0. Y0. Z5.\nG53 G0 X0.\nT1 M6\nG91 G1 X5. F100.\nM30\n";
  const ProgramRun ran = to_text(text, setup_with_tool(fanuc));
  ASSERT_TRUE(ran.stopped);
  EXPECT_TRUE(ran.diagnostics.front().detail.starts_with("X, unknown since the change in line 3"))
      << ran.report();
}

// A variable without a value in an axis word: the other axes stand where they stood (D-168).
TEST(Unfollowed, IsTheAxisAloneWhoseWordHasAVariable) {
  const auto behind = [](const std::string& line) {
    return refusal_of(
        "G71 G17 G90\nT1 D1\nG0 X-20 Y0 Z5\n" + line + "\nG41 G1 X0 F100\nY40\nG40 X-20\nM30\n",
        setup_with_tool(sinumerik));
  };
  EXPECT_EQ(behind("G0 Z=TIEFE").first, 0);
  EXPECT_EQ(behind("G1 Z=R1 F100").first, 0);
  EXPECT_EQ(behind("G0 X=TIEFE"), std::pair(900106, 5U));
  EXPECT_EQ(behind("G0 Y=TIEFE"), std::pair(900106, 5U));
  const ProgramRun ran =
      to_text("G71 G90\nT1 D1\nG0 X0 Y0\nX=TIEFE\nG41 G1 Y9 F9\nM30\n", setup_with_tool(sinumerik));
  ASSERT_TRUE(ran.stopped);
  EXPECT_TRUE(ran.diagnostics.front().detail.starts_with("X, unknown since the variable in line 4"))
      << ran.report();
  EXPECT_NE(help_of(ran.diagnostics.front()).find("--variable"), std::string::npos);
}

TEST(Unfollowed, IsToldByItsNameWithinAContour) {
  const std::string begin = "G90 G17\nG0 X-20. Y-20. Z5.\nG41 D1 G1 X0. Y0. F500.\n";
  const std::string end = "\nY40.\nG40 X-20. Y-20.\nM30\n";
  const auto told = [&](DialectName dialect, const std::string& line) {
    return to_text(begin + line + end, computing_setup(dialect, 5)).report();
  };
  EXPECT_NE(told(fanuc, "G16").find("G16, polar coordinates"), std::string::npos);
  EXPECT_NE(told(fanuc, "G52 X0").find("G52, local coordinate system"), std::string::npos);
  EXPECT_NE(told(sinumerik, "TRANS X5").find("TRANS, "), std::string::npos);
}

// The axis words are percentages: nothing moves, also within a contour (D-182).
TEST(AxisWeights, OfIsgArePassedOn) {
  const std::string head = "G71 G17 G90 D1\nG00 X-20 Y0\n";
  const std::string contour = "G41 G01 X0 Y0 F500\nY40\nX40\nG40 X60\nM30\n";
  const auto setup = setup_with_tool(isg);
  const std::string plain = to_text(head + contour, setup).text;
  for (const std::string weights :
       {"G130 X80 Y80 Z80", "G132 X200", "G136 X80 Y95 Z0", "G230 X=70", "G333 Y50", "G338 Z60",
        "G135 G136 X80", "G136 Y95 G135", "G130 X50 M8", "G231=80", "G233 = 80", "G334=80",
        "G339=80", "G129=70"}) {
    const ProgramRun before = to_text(head + weights + "\n" + contour, setup);
    EXPECT_FALSE(before.stopped) << before.report();
    EXPECT_EQ(before.text, head + weights + "\n" + plain.substr(head.size())) << weights;
    const ProgramRun within =
        to_text(head + "G41 G01 X0 Y0 F500\nY40\n" + weights + "\nX40\nG40 X60\nM30\n", setup);
    EXPECT_FALSE(within.stopped) << within.report();
    std::string without = within.text;
    const std::size_t place = without.find(weights);
    ASSERT_NE(place, std::string::npos) << within.text;
    without.erase(place, weights.size() + 1);
    EXPECT_EQ(without, plain) << weights;
  }
  // What moves or says a place in the same block is not told apart from them.
  for (const std::string words :
       {"G01 G130 X80", "G130 X80 I5", "G130 X80 R5", "G41 G130 X80", "G40 G132 X80",
        "G04 G130 X80", "G92 G130 X80", "G136 G54 X80", "G74 G130 X1", "G33 G130 X80",
        "G130 X80 #RND=5", "G130 #SUPPRESS OFFSETS X80", "G112 X80", "G131=80 X80"})
    EXPECT_EQ(refusal_of(head + words + "\nM30\n", setup), std::pair(900003, 3U)) << words;
  const ProgramRun refused = to_text(head + "G130 G01 X80\nM30\n", setup);
  EXPECT_EQ(refused.diagnostics.front().detail,
            "G130, percentages of axes, beside a motion or another function of axes");
  // Increments count from where the tool stands.
  EXPECT_EQ(refusal_of(head + "G130 X80\nG91 X-5\nG90\n" + contour, setup), std::pair(0, 0U));
}

TEST(RapidWeights, OfIsgMayStandBesideAMotion) {
  const std::string text =
      "G71 G17 G90 D1\nG00 X-20 Y0\nG129 = 70 X-10 Y0\nG41 G01 X0 Y0 F500\n"
      "G293 Y40 F400\nG193 X40 F300\nG40 X60\nM30\n";
  const ProgramRun ran = to_text(text, setup_with_tool(isg));
  EXPECT_FALSE(ran.stopped) << ran.report();
  EXPECT_NE(ran.text.find("\nG129 = 70 X-10 Y0\n"), std::string::npos) << ran.text;
  EXPECT_NE(ran.text.find("G293"), std::string::npos) << ran.text;
}

// The motion of the block goes to a place of the machine (D-183).
TEST(SuppressedOffsets, OfIsgAreCopiedWhileTrcIsOff) {
  const auto setup = setup_with_tool(isg);
  const std::string head = "G71 G17 G90 D1\nG00 X-20 Y0\n";
  const std::string contour = "G41 G01 X0 Y0 F500\nY40\nG40 X-20\nM30\n";
  const std::string known = "G00 X-20 Y0\n";
  for (const std::string line :
       {"#SUPPRESS OFFSETS X50 Y100", "N30 #SUPPRESS OFFSETS [ZERO ADD_ZERO] X50 (park)",
        "#SUPPRESS OFFSETS[ZERO] G01 Y5 F300", "G00 #SUPPRESS OFFSETS X=50 M9",
        "# suppress offsets [TOOL] X0 Y0 ; home"}) {
    const std::string lines = head + line + "\n";
    EXPECT_EQ(flat_of(lines + "M30\n", setup), lines + "M30\n");
    EXPECT_EQ(refusal_of(lines + contour, setup), std::pair(900106, 4U)) << line;
    EXPECT_EQ(refusal_of(lines + known + contour, setup), std::pair(0, 0U)) << line;
    EXPECT_EQ(refusal_of(head + "G41 G01 X0 Y0 F500\n" + line + "\nY40\nG40 X-20\nM30\n", setup),
              std::pair(900003, 4U))
        << line;
    EXPECT_EQ(refusal_of(head + "G41 G01 X0 Y0 F500\nY40\nG40\n" + line + "\nM30\n", setup),
              std::pair(900003, 6U))
        << line;
  }
  // The axes that it does not name stay where they are.
  EXPECT_EQ(refusal_of(head + "#SUPPRESS OFFSETS Z50\n" + contour, setup), std::pair(0, 0U));
  EXPECT_EQ(refusal_of(head + "#SUPPRESS OFFSETS G41 X50\nM30\n", setup), std::pair(900003, 3U));
  const ProgramRun refused =
      to_text(head + "G41 G01 X0 Y0 F500\n#SUPPRESS OFFSETS X50\nG40 X-20\nM30\n", setup);
  EXPECT_EQ(refused.diagnostics.front().detail, "#SUPPRESS OFFSETS while TRC is active");
  // Values of a program that computes.
  EXPECT_EQ(flat_of("P1=50\n#SUPPRESS OFFSETS XP1 Y=P1\nM30\n", setup),
            "#SUPPRESS OFFSETS X50 Y=50\nM30\n");
}

// The motion takes the feed in force: the output has that of the program again before it.
TEST(SuppressedOffsets, OfIsgMoveAtTheFeedOfTheProgram) {
  ProgramSessionSetup setup = setup_with_tool(isg);
  const std::string before =
      "G71 G17 G90 D1\nG00 X-20 Y0\nG41 G11 G01 X0 Y0 F500\nG02 X20 Y0 I10\nG40 G01 X40\n";
  const std::string moved = to_text(before + "G01 X50\nM30\n", setup).text;
  const std::string copied = to_text(before + "#SUPPRESS OFFSETS X50\nM30\n", setup).text;
  EXPECT_NE(copied.find("F500\n#SUPPRESS"), std::string::npos) << copied << moved;
}

// A zero offset that the program writes, as G10 L2 elsewhere (D-184).
TEST(ZeroOffsets, OfIsgAreWrittenWhileTrcIsOff) {
  const auto setup = setup_with_tool(isg);
  const std::string head = "G71 G17 G90 D1\nG54\nG00 X-20 Y0\n";
  const std::string contour = "G41 G01 X0 Y0 F500\nY40\nG40 X-20\nM30\n";
  for (const std::string line :
       {"V.G.NP[1].V.X = 11", "N05 v.g.np[12].V.Y=22 (G54)", "V.G.NP[1].V[0] = -1.5",
        "V.G.NP_AKT.V.X = 200", "V.G.NP_AKT.V[0] = 200", "V.G.NP_AKT.ALL += V.G.NP[2].ALL",
        "V.G.NP[12].ALL=V.G.NP_AKT.ALL + V.G.NP[2].ALL ; saved", "V.G.NP_DEFAULT = 2"}) {
    const std::string lines = head + line + "\n";
    EXPECT_EQ(flat_of(lines + "M30\n", setup), lines + "M30\n");
    EXPECT_EQ(refusal_of(lines + contour, setup), std::pair(900106, 5U)) << line;
    EXPECT_EQ(refusal_of(lines + "G54\nG00 X-20 Y0\n" + contour, setup), std::pair(0, 0U)) << line;
    EXPECT_EQ(refusal_of(lines + "G00 X-20 Y0\nG54\n" + contour, setup), std::pair(900106, 7U))
        << line;
    EXPECT_EQ(refusal_of(head + "G41 G01 X0 Y0 F500\n" + line + "\nY40\nG40 X-20\nM30\n", setup),
              std::pair(900003, 5U))
        << line;
  }
  for (const std::string line : {"V.G.NP[1].V.X = 11 G01 X5", "G01 X5 V.G.NP[1].V.X = 11",
                                 "V.G.NP[1].V.X", "V.G.NP = 5", "V.G.NPX = 5"})
    EXPECT_EQ(refusal_of(head + line + "\nM30\n", setup).second, 4U) << line;
  const ProgramRun refused =
      to_text(head + "G41 G01 X0 Y0 F500\nV.G.NP[1].V.X=1\nG40 X-20\nM30\n", setup);
  EXPECT_EQ(refused.diagnostics.front().detail,
            "V.G.NP, a zero offset, in a contour or beside other words");
  // In a program that computes.
  EXPECT_EQ(flat_of("P1=5 P2=1\nV.G.NP[1].V.X = 2*P1\nV.G.NP[P2].V.Y = P1\nV.G.NP_AKT.V.X = 3\n"
                    "V.G.NP[12].ALL = V.G.NP_AKT.ALL\nG0 XP1\nM30\n",
                    setup),
            "V.G.NP[1].V.X = 10\nV.G.NP[1].V.Y = 5\nV.G.NP_AKT.V.X = 3\n"
            "V.G.NP[12].ALL = V.G.NP_AKT.ALL\nG0 X5\nM30\n");
  EXPECT_EQ(refusal_of("P1=5\nG0 X0 Y0\nV.G.NP[1].V.X = P1\n" + contour, setup),
            std::pair(900106, 4U));
  // The machine does not get the radius that TRC resolves.
  EXPECT_EQ(flat_of("D1\nV.G.NP[1].V.X = V.G.WZ_AKT.R\nM30\n", setup),
            "D1\nV.G.NP[1].V.X = 2\nM30\n");
  EXPECT_EQ(refusal_of("P1=5\nV.G.NP[1].ALL = V.G.NP[2].ALL + P1\nM30\n", setup),
            std::pair(900307, 2U));
}

}  // namespace
}  // namespace trc::support
