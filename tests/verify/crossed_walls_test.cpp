#include "core/verify/crossed_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/programs/computing.h"
#include "tests/support/program_run.h"

namespace trc::verify {
namespace {

using support::ProgramRun;

ProgramRun run(const std::string& program, Verify verify = Verify::report) {
  ProgramSessionSetup setup{.nc_text = false};
  setup.session.verify = verify;
  setup.session.program.mode.tool_radius = 5;
  return support::to_blocks(program, setup);
}

std::string told(const std::string& program, Verify verify = Verify::report) {
  return run(program, verify).codes();
}

// A part of 100 by 60 mm, the tool outside of it, from the middle of its left wall.
const std::string round_the_part = "G1 G41 X0 Y30\nY60\nX100\nY0\nX0\nY30\n";

// Two lines lead there: line 2 is the approach.
std::string from(const std::string& start) { return "G0 " + start + " F300\n" + round_the_part; }

TEST(CrossedWalls, OfARetractAreTold) {  // D-166
  EXPECT_EQ(told(from("X-40 Y30") + "G40 X120 Y42\nM30\n"), "900229 at line 8");
  EXPECT_EQ(told(from("X-40 Y30") + "G40 X-40\nM30\n"), "");
  // It ends in the part.
  EXPECT_EQ(told(from("X-40 Y30") + "G40 X50\nM30\n"), "900229 at line 8");
}

TEST(CrossedWalls, OfAnApproachAreTold) {
  EXPECT_EQ(told(from("X120 Y42") + "G40 X-40\nM30\n"), "900229 at line 2");
  EXPECT_EQ(told(from("X50 Y30") + "G40 X-40\nM30\n"), "900229 at line 2");
  EXPECT_EQ(told(from("X-40 Y90") + "G40 X-40\nM30\n"), "");
}

// The old coordinates of the start are none of the contour (D-170).
TEST(CrossedWalls, AreNotAskedForFromAPlaceNobodyKnows) {
  EXPECT_EQ(told("G138\n" + from("X120 Y42") + "G40 X-40\nM30\n"), "900229 at line 3");
  EXPECT_EQ(told("G138\n" + from("X120 Y42\nG55") + "G40 X-40\nM30\n"), "");
  EXPECT_EQ(told("G138\n" + from("X120 Y42\nG55") + "G40 X120 Y42\nM30\n"), "900229 at line 10");
}

TEST(CrossedWalls, AreToldWithThePlace) {
  // The path ends at X-5 Y35.
  const ProgramRun ran = run(from("X-40 Y30") + "G40 X120\nM30\n");
  ASSERT_EQ(ran.diagnostics.size(), 1U);
  ASSERT_TRUE(ran.diagnostics.front().point);
  EXPECT_NEAR(ran.diagnostics.front().point->x, 0, 1e-9);
  EXPECT_NEAR(ran.diagnostics.front().point->y, 34.8, 1e-9);
}

TEST(CrossedWalls, AreAnErrorWhereMeasuringIsEnforced) {  // D-166
  const std::string program = from("X120 Y42") + "G40 X-40\nM30\n";
  EXPECT_FALSE(run(program).stopped);
  EXPECT_TRUE(run(program, Verify::enforce).stopped);
  EXPECT_EQ(told(program, Verify::enforce), "900229 at line 2");
  EXPECT_EQ(told(program, Verify::off), "");
}

TEST(CrossedWalls, AreNoneAboveThePath) {  // D-166
  EXPECT_EQ(told("G0 X-40 Y30 Z-5 F300\n" + round_the_part + "G0 Z20\nG40 X120 Y42\nM30\n"), "");
  EXPECT_EQ(told("G0 X-40 Y30 Z-5 F300\n" + round_the_part + "G40 X120 Y42 Z20\nM30\n"), "");
  // The contour has gone down since.
  EXPECT_EQ(told("G0 X120 Y42 Z1 F300\nG1 G41 X0 Y30\nG1 Y60 Z-5\nX100\nY0\nX0\nY30\n"
                 "G40 X-40\nM30\n"),
            "");
  EXPECT_EQ(told("G0 X-40 Y30 Z1 F300\nG1 G41 X0 Y30\nG1 Y60 Z-5\nX100\nY0\nX0\nY30\n"
                 "G40 X120 Y42\nM30\n"),
            "900229 at line 8");
}

TEST(CrossedWalls, AreNoneWhereTheWayBeginsOrEndsOnAWall) {
  EXPECT_EQ(told(from("X0 Y30") + "G40 X0 Y30.5\nM30\n"), "900236 at line 2");
  EXPECT_EQ(told(from("X0.002 Y30") + "G40 X0.002\nM30\n"), "");
  EXPECT_EQ(told(from("X0.02 Y31") + "G40 X-40\nM30\n"), "900229 at line 2");
}

// Where it begins and ends it may reach beyond the part, and the tool goes round it there.
TEST(CrossedWalls, OfAnOpenContourAreThoseBetweenItsEnds) {
  const std::string three_sides = "G0 X-30 Y-20 F300\nG1 G41 X0\nY40\nX50\nY-20\n";
  EXPECT_EQ(told(three_sides + "G40 X-30\nM30\n"), "");
  EXPECT_EQ(told(three_sides + "G40 X-30 Y0\nM30\n"), "");
  EXPECT_EQ(told(three_sides + "G40 X20 Y60\nM30\n"), "900229 at line 6");
  EXPECT_EQ(told("G0 X30 Y-30 F300\nG1 G41 X0 Y0\nX50\nG40 X80 Y-30\nM30\n"), "");
}

// The leads of a contour are no walls (D-38).
TEST(CrossedWalls, AreNoLeads) {
  const std::string leads =
      "G1 G41 X-20 Y20\nG3 X0 Y40 I0 J20\nG1 Y60\nX100\nY0\nX0\nY40\nG3 X-20 Y60 I-20 J0\n";
  EXPECT_EQ(told("G0 X-40 Y20 F300\n" + leads + "G1 G40 X-10 Y10\nM30\n"), "");
  EXPECT_EQ(told("G0 X-40 Y20 F300\n" + leads + "G1 G40 X20 Y10\nM30\n"), "900229 at line 10");
}

TEST(CrossedWalls, OfSelectionsInARowAreEachTheirOwn) {
  const std::string away = "G40 X-40\nG0 Y200\n";
  const std::string above = "G1 G41 X0 Y230\nY260\nX100\nY200\nX0\nY230\n";
  EXPECT_EQ(told(from("X-40 Y30") + away + above + "G40 X120 Y242\nM30\n"), "900229 at line 16");
  // The retract goes through the other part, which is not there for it.
  EXPECT_EQ(told(from("X-40 Y30") + "G40 X-40 Y300\nG0 X-40 Y200\n" + above + "G40 X-40\nM30\n"),
            "");
  EXPECT_EQ(told(from("X-40 Y30") + "G40 X50 Y30\nG0 X-40 Y200\n" + above + "G40 X50\nM30\n"),
            "900229 at line 8; 900229 at line 16");
}

// Klartext: the line of LCT leads through the part, not through its first or last block (D-161).
TEST(CrossedWalls, OfLeadsOfKlartextAreTold) {
  const auto part = [](const std::string& in, const std::string& out) {
    ProgramSessionSetup setup = support::computing_setup(DialectName::heidenhain, 5);
    setup.session.verify = Verify::report;
    return support::to_blocks("BEGIN PGM A MM\nTOOL CALL 5 Z S1000\nL X+120 Y+30 R0 FMAX\n" + in +
                                  " RL F300\nL Y+32\nL Y+60\nL X+100\nL Y+0\nL X+0\nL Y+28\n"
                                  "L Y+30\n" +
                                  out + "\nEND PGM A MM\n",
                              setup)
        .codes();
  };
  EXPECT_EQ(part("APPR LCT X+0 Y+30 R8", "DEP LT LEN20"), "900229 at line 4");
  EXPECT_EQ(part("L X-40 Y+20 R0\nAPPR LCT X+0 Y+30 R8", "DEP LCT X+120 Y+10 R8"),
            "900229 at line 13");
}

}  // namespace
}  // namespace trc::verify
