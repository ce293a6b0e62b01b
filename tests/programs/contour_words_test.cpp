#include <gtest/gtest.h>

#include <string>

#include "tests/programs/computing.h"

// Words that describe a contour by other means than ends of lines and centres of arcs. The output
// is that of the plain words (D-103, D-104, D-85).

namespace trc::support::contour_words {
namespace {

constexpr DialectName fanuc = DialectName::fanuc;
constexpr DialectName sinumerik = DialectName::sinumerik;
constexpr DialectName heidenhain = DialectName::heidenhain;

// After a wall from X0 Y0 to X0 Y40; the contour ends at the right.
std::string behind_wall(const std::string& lines, const std::string& end = "G40 G1 X90\n") {
  return "G17 G90 G71 G94\nG0 X-20 Y0\nG41 G1 X0 Y0 F300\nY40\n" + lines + end + "M30\n";
}

std::string compensated(const std::string& text, DialectName dialect = sinumerik) {
  return flat_of(text, computing_setup(dialect));
}

void expect_same(const std::string& lines, const std::string& plain) {
  EXPECT_EQ(compensated(behind_wall(lines)), compensated(behind_wall(plain))) << lines;
}

std::string refused(const std::string& lines, const std::string& end = "G40 G1 X90\n") {
  const ProgramRun ran = to_text(behind_wall(lines, end), computing_setup(sinumerik));
  return ran.diagnostics.empty() ? "" : ran.diagnostics.front().detail;
}

TEST(ContourWords, CtGoesOnAsTheContourLed) {  // D-103
  expect_same("CT X20 Y60\nG1 X50\n", "G2 X20 Y60 I20 J0\nG1 X50\n");
  expect_same("CT X20 Y60\nX40 Y40\nG1 Y0\n", "G2 X20 Y60 I20 J0\nG2 X40 Y40 I0 J-20\nG1 Y0\n");
  expect_same("CT X-10 Y50\nG1 X-30\n", "G3 X-10 Y50 I-10 J0\nG1 X-30\n");
  expect_same("G91 CT X20 Y20\nG90 G1 X50\n", "G91 G2 X20 Y20 I20 J0\nG90 G1 X50\n");
  expect_same("CT Y60\nG1 X50\n", "G1 Y60\nG1 X50\n");
  EXPECT_EQ(refused("CT Y30\nG1 X50\n"), "CT straight back");
  EXPECT_EQ(refused("CT X20 Y60\n", "G40 X90\n"), "CT while TRC is active");
  EXPECT_EQ(refused("CT X20 Y60\n", "G40\nX90\n"),
            "CT after a motion of the contour: program its centre");
}

TEST(ContourWords, CipHasAPointBetweenInEitherReference) {
  const std::string plain = "G2 X20 Y40 I10 J0\nG1 X50\n";
  expect_same("CIP X20 Y40 I1=10 J1=50\nG1 X50\n", plain);
  expect_same("CIP X20 Y40 I1=IC(10) J1=IC(10)\nG1 X50\n", plain);
  const std::string incremental = "G91 G2 X20 Y0 I10 J0\nG90 G1 X50\n";
  expect_same("G91 CIP X20 Y0 I1=AC(10) J1=AC(50)\nG90 G1 X50\n", incremental);
  expect_same("G91 CIP X=AC(20) Y0 I1=10 J1=AC(50)\nG90 G1 X50\n", incremental);
  // It holds up to another motion function.
  expect_same("CIP X20 Y40 I1=10 J1=50\nX40 Y40 I1=30 J1=30\nG1 X50\n",
              "G2 X20 Y40 I10 J0\nG3 X40 Y40 I10 J0\nG1 X50\n");
  EXPECT_EQ(refused("CIP X20 Y40 I1=10 J1=50\n", "G40\nX60 Y40 I1=50 J1=50\n"),
            "CIP of a contour, which holds after it: write CIP anew");
}

// By its manual a coordinate of 0 may be left out: where that is not where the arc starts, whether
// it means the zero of the program only the control knows.
TEST(ContourWords, CipMayLeaveOutACoordinateThatIsNought) {
  const std::string plain = "G2 X20 Y60 I10 J10\nG1 X50\n";
  expect_same("CIP X20 Y60 I1=0 J1=60\nG1 X50\n", plain);
  expect_same("CIP X20 Y60 J1=60\nG1 X50\n", plain);
  expect_same("G91 CIP X20 Y20 J1=20\nG90 G1 X50\n", "G91 G2 X20 Y20 I10 J10\nG90 G1 X50\n");
  EXPECT_EQ(refused("CIP X20 Y60 I1=20\nG1 X50\n"),
            "CIP, whose point between names one axis alone under G90");
}

TEST(ContourWords, TurnsWantTheCentreOfTheirArc) {
  EXPECT_EQ(refused("G2 X20 Y40 CR=10 TURN=2\nG1 X50\n"), "turns beside a radius");
}

// Words of an arc mean nothing where there is none.
TEST(ContourWords, WordsOfAnArcWantTheirArc) {
  const std::string reason = "a circle word without its arc";
  for (const char* const words :
       {"TURN=2", "TURN=0", "X20 TURN=2", "X20 TURN=0", "I1=5 J1=6", "X20 Y60 I1=10 J1=50"})
    EXPECT_EQ(refused(std::string(words) + "\nX50\n"), reason) << words;
  for (const char* const words : {"X20 Y60 CR=10", "CR=10", "X20 Y60 AR=90", "X20 I5", "I5 J5"})
    EXPECT_EQ(refused(std::string(words) + "\nX50\n"), "a circle word in a straight motion")
        << words;
  for (const char* const words : {"TURN=2", "I1=5 J1=6", "X20 Y40 I10 J0 I1=10 J1=50"})
    EXPECT_EQ(refused("G2 " + std::string(words) + "\nG1 X50\n"), reason) << words;
  EXPECT_EQ(refused("CIP X20 Y40 I1=10 J1=50\nI1=5 J1=6\nG1 X50\n"), reason);
  EXPECT_EQ(refused("AR=90\nX50\n"), "AR= with either its end or its centre");
  EXPECT_EQ(refused("CIP X20 Y40\nG1 X50\n"),
            "CIP, whose point between names the two axes of the plane");
  EXPECT_EQ(refused("CT X20 Y60 CR=10\nG1 X50\n"), "CT beside a centre or a radius");
}

TEST(ContourWords, TheAngleOfARotationWantsItsRotation) {
  EXPECT_EQ(refused("RPL=30\nX50\n"), "RPL=30, the angle of a rotation");
}

// It ends all frames, as TRANS alone does.
TEST(ContourWords, ScaleAloneHasNoPlaceInAContour) {
  EXPECT_EQ(refused("SCALE\nX20 Y60\n"), "SCALE, a frame while TRC is active");
}

TEST(ContourWords, ACornerIsCutWhereNothingElseMoves) {
  const std::string between = "X20 RND=8\n";
  expect_same(between + "M8\nM7\nS500\nY80\n", "X12\nG3 X20 Y48 I0 J8\nM8\nM7\nS500\nG1 Y80\n");
  EXPECT_EQ(refused(between + "M8\nM7\nS500\nM3\nY80\n"),
            "a rounding or a chamfer that is not between two motions of one contour, at feed and "
            "in the plane");
  EXPECT_EQ(refused(between + "G0 Z5\nG1 Z-7\nY80\n"),
            "a rounding or a chamfer that is not between two motions of one contour, at feed and "
            "in the plane");
  expect_same("RNDM=8\nX20\nG1 Z5\nY80 RNDM=0\n", "X20\nG01 Z5\nY80\n");
  // Where the contour does not turn there is none.
  expect_same("X20 RND=6\nX40\nY80\n", "X20\nX40\nY80\n");
}

TEST(ContourWords, AnAngleGivesTheOtherCoordinate) {  // D-103
  expect_same("X20 ANG=45\nX50\n", "X20 Y60\nX50\n");
  expect_same("Y60 ANG=45\nX50\n", "X20 Y60\nX50\n");
  expect_same("G91 X20 ANG=45\nG90 X50\n", "G91 X20 Y20\nG90 X50\n");
  expect_same("X50\n", "X50 ANG=0\n");
  EXPECT_EQ(refused("ANG=45\nX50 Y60 ANG=0\n"),
            "the angle of a motion without one of its coordinates alone");
  EXPECT_EQ(refused("Y60 ANG=0\nX50\n"),
            "the angle of a motion without one of its coordinates alone");
  const std::string head = "G21 G90 G17\nG0 X-20. Y0.\nG41 D1 G1 X0. Y0. F300.\nY40.\n";
  EXPECT_EQ(compensated(head + "X20. ,A45.\nX50.\nG40 X90.\nM30\n", fanuc),
            compensated(head + "X20. Y60.\nX50.\nG40 X90.\nM30\n", fanuc));
}

TEST(ContourWords, CornersHaveTheirOwnFeed) {  // D-103
  const auto feeds = [](const std::string& lines) {
    std::string all;
    const std::string text =
        "G17 G90 G71 G94 CFTCP\nG0 X-20 Y0\nG41 G1 X0 Y0 F300\n" + lines + "G40 X90\nM30\n";
    for (const CompensatedBlock& block : to_blocks(text, computing_setup(sinumerik)).blocks)
      if (is_arc(block.path)) all += std::to_string(static_cast<int>(block.feed)) + " ";
    return all;
  };
  EXPECT_EQ(feeds("Y40 RND=5 FRC=100\nX50 RND=5\nY0\n"), "100 300 ");
  EXPECT_EQ(feeds("FRCM=80\nY40 RND=5\nX50 RND=5 FRC=60\nY0\n"), "80 60 ");
  EXPECT_EQ(feeds("FRCM=80\nY40 RND=5\nFRCM=0\nX50 RND=5\nY0\n"), "80 300 ");
}

TEST(ContourWords, ExtcallNeedsNoBrackets) {  // D-104
  const std::string text = "G17 G90 G71 G94\nG0 X0 Y0\nEXTCALL \"POCKET.SPF\" ; ROUGH\nM30\n";
  EXPECT_EQ(compensated(text), text);
  const std::string behind = "EXTCALL \"POCKET\"\nG41 G1 X0 Y0 F300\nY40\nG40 X-20\nM30\n";
  EXPECT_NE(compensated("G17 G90 G71 G94\nG0 X0 Y0\n" + behind).find("900106"), std::string::npos);
}

TEST(ContourWords, ParametersOfTheControlPass) {  // D-104
  const std::string text =
      "G21 G90 G17\nSETVN 500[WIDTH,DEPTH]\nG0 X0. Y0.\nG10 L52\nN5003 P1 R0\nN1420 P2 R5000\n"
      "G11\nG0 X1. Y1. Z1.\nM30\n";
  EXPECT_EQ(compensated(text, fanuc), text);
}

TEST(ContourWords, FormulasOfKlartextAreComputed) {  // D-85
  const auto contour = [](const std::string& lines, const std::string& height) {
    return compensated("BEGIN PGM A MM\n" + lines +
                           "TOOL CALL 1 Z S1000\nL X-20 Y+0 R0 FMAX\nL X+0 Y+0 RL F300\nL Y" +
                           height + "\nL X+50\nL X+90 R0\nEND PGM A MM\n",
                       heidenhain);
  };
  for (const std::string formula :
       {"40", "10 + 3 * 10", "(1 + 3) * 10", "20 * SIN 90 * 2", "SQRT 1600", "SQ 6 + 2 ^ 2",
        "80 * COS 60", "ABS -40", "INT 40.9", "NEG (0 - 40)", "-(-40)", "160 / 2 / 2",
        "Q9 * Q9 + 4"})
    EXPECT_EQ(contour("Q9 = 6\nQ1 = " + formula + "\n", "+Q1"),
              contour("Q9 = 6\nQ1 = " + formula + "\n", "+40"))
        << formula;
  for (const std::string formula : {"400 % 360", "1 / 0", "Q2 + 1", "SIN", "(40", "2 ^ 2 ^ 2"})
    EXPECT_NE(contour("Q1 = " + formula + "\n", "+Q1").find("900003"), std::string::npos)
        << formula;
}

}  // namespace
}  // namespace trc::support::contour_words
