// Rows of the rule book that no worked example covers, as NC text. The coordinates are
// worked out by hand from the rules: beside G41 the path lies to the left of the contour.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "core/nc/text/number_format.h"
#include "tests/support/program_run.h"

namespace trc::support {
namespace {

// The path after `G0` to the start: one line a block, without numbers and feeds.
std::string path_of(const std::string& program, const std::string& reports = "") {
  const ProgramRun run = to_blocks(program);
  EXPECT_FALSE(run.stopped) << run.codes();
  EXPECT_EQ(run.codes(), reports);
  std::string path;
  for (const CompensatedBlock& block : run.blocks) {
    if (block.origin == Origin::passthrough || block.origin == Origin::uncompensated) continue;
    CompensatedBlock bare = block;
    bare.source = {};
    bare.feed = 0;
    path += listing_of({bare});
  }
  return path;
}

// Radius 5, transitions G26 unless another is given.
std::string program_of(const std::string& start, const std::string& head,
                       const std::string& contour) {
  return "G0 " + start + " F100\nG26 V.G.WZ_AKT.R=5\n" + head + "\n" + contour + "\nM30\n";
}

TEST(Selection, AloneInALineActsWithTheNextMotion) {
  const std::string expected =
      path_of(program_of("X0 Y0", "", "G41 G1 X20 Y0\nX60\nY30\nG40 X80 Y60"));
  EXPECT_EQ(path_of(program_of("X0 Y0", "", "G41\nG1 X20 Y0\nX60\nY30\nG40\nX80 Y60")), expected);
  EXPECT_EQ(path_of(program_of("X0 Y0", "",
                               "G41\nM8\nZ-2\nZ0\nG1 X20 Y0\nX60\nY30\nG40\nZ3\nZ0\n"
                               "X80 Y60")),
            expected)
      << "motions across the plane do not count";
  EXPECT_EQ(path_of(program_of("X0 Y0", "",
                               "V.G.WZ_AKT.R=-5\nG42\nG1 X20 Y0\nX60\nY30\nG40\n"
                               "X80 Y60")),
            expected)
      << "a negative radius swaps the side";
}

// On the circle of radius 20 about (20, 0) the point at R = 2 before the corner (20, 20) is
// (18.0025, 19.9); the arc about the corner goes on by 90 degrees and the 2.866 of the chord.
TEST(SelectionBlock, MayBeCircularWhereItsModeSaysSo) {
  const std::string in = "G41 G2 X20 Y20 I20\nG1 X40\nG40 X60";
  const std::string out = "G41 G1 X20\nX40\nG40 G2 X60 Y0 J-20";
  const auto program = [](const char* start, const char* mode, const std::string& contour) {
    return program_of(start, std::string("V.G.WZ_AKT.R=2 ") + mode, contour);
  };
  EXPECT_EQ(path_of(program("X0 Y0", "G236", in)),
            "- approach arc 0.0000 0.0000 0.0000 -> 18.0025 19.9000 0.0000 "
            "center 20.0000 0.0000 0.0000 sweep -84.2680\n"
            "- approach arc 18.0025 19.9000 0.0000 -> 20.0000 22.0000 0.0000 "
            "center 20.0000 20.0000 0.0000 sweep -92.8660\n"
            "- programmed line 20.0000 22.0000 0.0000 -> 40.0000 22.0000 0.0000\n"
            "- retract arc 40.0000 22.0000 0.0000 -> 42.0000 20.0000 0.0000 "
            "center 40.0000 20.0000 0.0000 sweep -90.0000\n"
            "- retract line 42.0000 20.0000 0.0000 -> 60.0000 20.0000 0.0000\n");
  EXPECT_EQ(path_of(program("X0 Y20", "G236", out)),
            "- approach line 0.0000 20.0000 0.0000 -> 18.0000 20.0000 0.0000\n"
            "- approach arc 18.0000 20.0000 0.0000 -> 20.0000 22.0000 0.0000 "
            "center 20.0000 20.0000 0.0000 sweep -90.0000\n"
            "- programmed line 20.0000 22.0000 0.0000 -> 40.0000 22.0000 0.0000\n"
            "- retract arc 40.0000 22.0000 0.0000 -> 41.9975 19.9000 0.0000 "
            "center 40.0000 20.0000 0.0000 sweep -92.8660\n"
            "- retract arc 41.9975 19.9000 0.0000 -> 60.0000 0.0000 0.0000 "
            "center 40.0000 0.0000 0.0000 sweep -84.2680\n");
  // Under G237 it is the first contour block, outside: 20 + 2.
  EXPECT_EQ(path_of(program("X0 Y0", "G237", in)),
            "- approach line 0.0000 0.0000 0.0000 -> -2.0000 0.0000 0.0000\n"
            "- programmed arc -2.0000 0.0000 0.0000 -> 20.0000 22.0000 0.0000 "
            "center 20.0000 0.0000 0.0000 sweep -90.0000\n"
            "- programmed line 20.0000 22.0000 0.0000 -> 40.0000 22.0000 0.0000\n"
            "- retract line 40.0000 22.0000 0.0000 -> 40.0000 20.0000 0.0000\n");
  for (const char* mode : {"G138", "G139", "G238", "G239"})
    EXPECT_EQ(to_blocks(program("X0 Y0", mode, in)).codes(), "90008 at line 4") << mode;
  for (const char* mode : {"G138", "G139", "G238"})
    EXPECT_EQ(to_blocks(program("X0 Y20", mode, out)).codes(), "900203 at line 6") << mode;
}

// The mirror image of the entry at 63.43 degrees: where the equidistant meets the block of
// G40 the tool goes over to it. Before it lies a straight entry along the contour.
TEST(OnThePathDeselection, LeavesWhereTheEquidistantMeetsTheRetractBlock) {
  EXPECT_EQ(path_of(program_of("X5 Y90", "V.G.WZ_AKT.R=10 G236", "G42 G1 X20 Y60\nX50 Y0\nG40 X0")),
            "- approach line 5.0000 90.0000 0.0000 -> 15.5279 68.9443 0.0000\n"
            "- approach arc 15.5279 68.9443 0.0000 -> 11.0557 55.5279 0.0000 "
            "center 20.0000 60.0000 0.0000 sweep 90.0000\n"
            "- programmed line 11.0557 55.5279 0.0000 -> 38.8197 0.0000 0.0000\n"
            "- retract line 38.8197 0.0000 0.0000 -> 0.0000 0.0000 0.0000\n");
}

TEST(GenCirBlockInCorner, PutsACircleOfRadiusZeroIntoInsideCornersOnly) {
  EXPECT_EQ(path_of(program_of("X0 Y0", "#TRC[GEN_CIR_BLOCK_IN_CORNER=1]",
                               "G41 G1 X20\nX60\nY40\nX90\nG40 X120")),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 55.0000 5.0000 0.0000\n"
            "- transition arc 55.0000 5.0000 0.0000 -> 55.0000 5.0000 0.0000 "
            "center 55.0000 5.0000 0.0000 sweep 90.0000\n"
            "- programmed line 55.0000 5.0000 0.0000 -> 55.0000 40.0000 0.0000\n"
            "- transition arc 55.0000 40.0000 0.0000 -> 60.0000 45.0000 0.0000 "
            "center 60.0000 40.0000 0.0000 sweep -90.0000\n"
            "- programmed line 60.0000 45.0000 0.0000 -> 90.0000 45.0000 0.0000\n"
            "- retract line 90.0000 45.0000 0.0000 -> 120.0000 40.0000 0.0000\n");
  EXPECT_EQ(path_of(program_of("X0 Y0", "V.G.WZ_AKT.R=0\n#TRC[GEN_CIR_BLOCK_IN_CORNER=1]",
                               "G41 G1 X20\nX60\nY40\nG40 Y80"),
                    "900220 at line 5"),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 0.0000 0.0000\n"
            "- programmed line 20.0000 0.0000 0.0000 -> 60.0000 0.0000 0.0000\n"
            "- programmed line 60.0000 0.0000 0.0000 -> 60.0000 40.0000 0.0000\n"
            "- retract line 60.0000 40.0000 0.0000 -> 60.0000 80.0000 0.0000\n")
      << "needs a radius";
}

// The joint of a turn of 2 degrees, and those of an arc that runs in and out tangentially.
TEST(TangentialLimit, MarksJointsUpToItsAngle) {
  const auto marks = [](const std::string& limit, const std::string& contour) {
    const ProgramRun run =
        to_blocks("G0 X0 Y0 F100\nG26 V.G.WZ_AKT.R=5\n" + limit + "G41 G1 X20\nX60\n" + contour);
    EXPECT_FALSE(run.stopped) << run.codes();
    std::string text;
    for (const CompensatedBlock& block : run.blocks)
      if (block.origin == Origin::programmed || block.origin == Origin::transition)
        text += block.tangential ? 't' : 'k';
    return text;
  };
  const std::string inside = "X100 Y1.3968\nG40 X140\nM30\n";  // 40 tan 2° = 1.3968
  EXPECT_EQ(marks("", inside), "kt") << "3 degrees are initial";
  EXPECT_EQ(marks("#TRC[TANGENTIAL_LIMIT=2.1]\n", inside), "kt");
  EXPECT_EQ(marks("#TRC[TANGENTIAL_LIMIT=1.9]\n", inside), "kk");
  EXPECT_EQ(marks("#TRC[TANGENTIAL_LIMIT=0.1]\n", "Y-40\nG40 X140\nM30\n"), "ktt")
      << "the arc about the corner has no kink";
}

// In all pairs of lines and circles, where the path goes on tangentially.
TEST(PerpendicularRadiusChange, StepsAcrossATangentialJoint) {
  const std::string head = "#TRC[PERPENDICULAR_RADIUS_CHANGE=1]";
  const std::string change = "V.G.WZ_AKT.R=6\n";
  EXPECT_EQ(path_of(program_of("X0 Y0", head, "G41 G1 X20\nX40\n" + change + "X60\nG40 X80")),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 40.0000 5.0000 0.0000\n"
            "- radius_change line 40.0000 5.0000 0.0000 -> 40.0000 6.0000 0.0000\n"
            "- programmed line 40.0000 6.0000 0.0000 -> 60.0000 6.0000 0.0000\n"
            "- retract line 60.0000 6.0000 0.0000 -> 80.0000 0.0000 0.0000\n");
  EXPECT_EQ(path_of(program_of("X0 Y0", head,
                               "G41 G1 X20\nX40\n" + change + "G3 X70 Y30 J30\nG40 G1 Y50")),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 40.0000 5.0000 0.0000\n"
            "- radius_change line 40.0000 5.0000 0.0000 -> 40.0000 6.0000 0.0000\n"
            "- programmed arc 40.0000 6.0000 0.0000 -> 64.0000 30.0000 0.0000 "
            "center 40.0000 30.0000 0.0000 sweep 90.0000\n"
            "- retract line 64.0000 30.0000 0.0000 -> 70.0000 50.0000 0.0000\n");
  const std::string arc_first = "G41 G1 X10\nG3 X40 Y30 J30\n" + change;
  const std::string before =
      "- approach line -20.0000 0.0000 0.0000 -> 10.0000 5.0000 0.0000\n"
      "- programmed arc 10.0000 5.0000 0.0000 -> 35.0000 30.0000 0.0000 "
      "center 10.0000 30.0000 0.0000 sweep 90.0000\n"
      "- radius_change line 35.0000 30.0000 0.0000 -> 34.0000 30.0000 0.0000\n";
  EXPECT_EQ(path_of(program_of("X-20 Y0", head, arc_first + "G1 Y60\nG40 Y80")),
            before +
                "- programmed line 34.0000 30.0000 0.0000 -> 34.0000 60.0000 0.0000\n"
                "- retract line 34.0000 60.0000 0.0000 -> 40.0000 80.0000 0.0000\n");
  EXPECT_EQ(path_of(program_of("X-20 Y0", head, arc_first + "G2 X60 Y50 I20\nG40 G1 X90")),
            before +
                "- programmed arc 34.0000 30.0000 0.0000 -> 60.0000 56.0000 0.0000 "
                "center 60.0000 30.0000 0.0000 sweep -90.0000\n"
                "- retract line 60.0000 56.0000 0.0000 -> 90.0000 50.0000 0.0000\n");
}

// The corner keeps the old radius, with lines and with an arc; the step follows it.
TEST(PerpendicularRadiusChange, StepsAfterAnOutsideCorner) {
  const std::string contour = "G41 G1 X20\nX40\nV.G.WZ_AKT.R=6\nY-30\nG40 Y-50";
  const std::string head = "#TRC[PERPENDICULAR_RADIUS_CHANGE=1]";
  EXPECT_EQ(path_of(program_of("X0 Y0", "G25\n" + head, contour)),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 45.0000 5.0000 0.0000\n"
            "- radius_change line 45.0000 5.0000 0.0000 -> 46.0000 5.0000 0.0000\n"
            "- programmed line 46.0000 5.0000 0.0000 -> 46.0000 -30.0000 0.0000\n"
            "- retract line 46.0000 -30.0000 0.0000 -> 40.0000 -50.0000 0.0000\n");
  EXPECT_EQ(path_of(program_of("X0 Y0", head, contour)),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 40.0000 5.0000 0.0000\n"
            "- transition arc 40.0000 5.0000 0.0000 -> 45.0000 0.0000 0.0000 "
            "center 40.0000 0.0000 0.0000 sweep -90.0000\n"
            "- radius_change line 45.0000 0.0000 0.0000 -> 46.0000 0.0000 0.0000\n"
            "- programmed line 46.0000 0.0000 0.0000 -> 46.0000 -30.0000 0.0000\n"
            "- retract line 46.0000 -30.0000 0.0000 -> 40.0000 -50.0000 0.0000\n");
}

// Line y = 5 meets the circle of radius 30 - 5 about (10, 0) in x = 10 + √600; from there
// the step goes along the radius of the circle.
TEST(PerpendicularRadiusChange, StepsFromTheFootInAnInsideCornerWithACircle) {
  EXPECT_EQ(path_of(program_of("X-20 Y0", "#TRC[PERPENDICULAR_RADIUS_CHANGE=1]",
                               "G41 G1 X10\nX40\nV.G.WZ_AKT.R=6\nG3 X10 Y30 I-30\nG1 X-40\nG40 "
                               "X-90")),
            "- approach line -20.0000 0.0000 0.0000 -> 10.0000 5.0000 0.0000\n"
            "- programmed line 10.0000 5.0000 0.0000 -> 34.4949 5.0000 0.0000\n"
            "- radius_change line 34.4949 5.0000 0.0000 -> 33.5151 4.8000 0.0000\n"
            "- programmed arc 33.5151 4.8000 0.0000 -> 10.0000 24.0000 0.0000 "
            "center 10.0000 0.0000 0.0000 sweep 78.4630\n"
            "- programmed line 10.0000 24.0000 0.0000 -> -40.0000 24.0000 0.0000\n"
            "- retract line -40.0000 24.0000 0.0000 -> -90.0000 30.0000 0.0000\n");
}

TEST(RadiusChange, IsTheSameByAToolWordAndByTheVariable) {
  ProgramSessionSetup setup;
  setup.session.program.tools = {{1, 5}, {2, 6}};
  const auto listing = [&](const std::string& first, const std::string& second) {
    return to_blocks("G0 X0 Y0 F100\nN1 " + first + "\nN2 G41 G1 X20\nN3 X40\nN4 " + second +
                         "\nN5 X60 Y10\nN6 X90\nN7 G40 X120\nN8 M30\n",
                     setup)
        .blocks;
  };
  const auto by_word = listing("D1", "D2");
  const auto by_variable = listing("V.G.WZ_AKT.R=5", "V.G.WZR=6");
  const auto path = [](const std::vector<CompensatedBlock>& blocks) {
    std::string text;
    for (const CompensatedBlock& block : blocks)
      if (block.origin != Origin::passthrough) text += listing_of({block});
    return text;
  };
  EXPECT_FALSE(path(by_word).empty());
  // The D word passes on as technology, the variable does not: only the places differ.
  EXPECT_EQ(path(by_word), path(by_variable));
}

// The side changes by the rules of each mode. Both corners of the change block are inside
// corners of 135 degrees, so that the straight modes end in Q and begin in P.
TEST(SideChange, FollowsTheModeItLeavesAndEnters) {
  const std::string contour = "G41 G1 X20\nX60\nG42 X100 Y40\nX140\nG40 X160 Y0";
  const std::string straight =
      "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
      "- programmed line 20.0000 5.0000 0.0000 -> 60.0000 5.0000 0.0000\n"
      "- approach line 60.0000 5.0000 0.0000 -> 100.0000 35.0000 0.0000\n"
      "- programmed line 100.0000 35.0000 0.0000 -> 140.0000 35.0000 0.0000\n";
  const std::string retract = "- retract line 140.0000 35.0000 0.0000 -> 160.0000 0.0000 0.0000\n";
  for (const char* mode : {"G138", "G139"})
    EXPECT_EQ(path_of(program_of("X0 Y0", mode, contour)), straight + retract) << mode;
  EXPECT_EQ(path_of(program_of("X0 Y0", "G239", contour)), straight) << "no block of its own";
  // On the programmed block between two arcs about its ends, 5 / √2 each way.
  EXPECT_EQ(path_of(program_of("X0 Y0", "G236", contour)),
            "- approach line 0.0000 0.0000 0.0000 -> 15.0000 0.0000 0.0000\n"
            "- approach arc 15.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000 "
            "center 20.0000 0.0000 0.0000 sweep -90.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 60.0000 5.0000 0.0000\n"
            "- retract arc 60.0000 5.0000 0.0000 -> 63.5355 3.5355 0.0000 "
            "center 60.0000 0.0000 0.0000 sweep -45.0000\n"
            "- approach line 63.5355 3.5355 0.0000 -> 96.4645 36.4645 0.0000\n"
            "- approach arc 96.4645 36.4645 0.0000 -> 100.0000 35.0000 0.0000 "
            "center 100.0000 40.0000 0.0000 sweep 45.0000\n"
            "- programmed line 100.0000 35.0000 0.0000 -> 140.0000 35.0000 0.0000\n"
            "- retract arc 140.0000 35.0000 0.0000 -> 142.2361 35.5279 0.0000 "
            "center 140.0000 40.0000 0.0000 sweep 26.5651\n"
            "- retract line 142.2361 35.5279 0.0000 -> 160.0000 0.0000 0.0000\n");
  // Out and in across the contour.
  EXPECT_EQ(path_of(program_of("X0 Y0", "G237", contour)),
            "- approach line 0.0000 0.0000 0.0000 -> 0.0000 5.0000 0.0000\n"
            "- programmed line 0.0000 5.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
            "- programmed line 20.0000 5.0000 0.0000 -> 60.0000 5.0000 0.0000\n"
            "- retract line 60.0000 5.0000 0.0000 -> 60.0000 0.0000 0.0000\n"
            "- approach line 60.0000 0.0000 0.0000 -> 100.0000 40.0000 0.0000\n"
            "- approach line 100.0000 40.0000 0.0000 -> 100.0000 35.0000 0.0000\n"
            "- programmed line 100.0000 35.0000 0.0000 -> 140.0000 35.0000 0.0000\n"
            "- retract line 140.0000 35.0000 0.0000 -> 140.0000 40.0000 0.0000\n");
}

// With the shift 0 the programmed path stays, and so do the roles of its blocks.
TEST(SuppressTrc, LeavesTheProgrammedPath) {  // D-155
  EXPECT_EQ(path_of(program_of("X0 Y0", "#TRC[SUPPRESS_TRC=1]",
                               "G41 G1 X20\nX40\nY-30\nG3 X60 Y-10 I20\nG40 G1 Y50")),
            "- approach line 0.0000 0.0000 0.0000 -> 20.0000 0.0000 0.0000\n"
            "- programmed line 20.0000 0.0000 0.0000 -> 40.0000 0.0000 0.0000\n"
            "- programmed line 40.0000 0.0000 0.0000 -> 40.0000 -30.0000 0.0000\n"
            "- programmed arc 40.0000 -30.0000 0.0000 -> 60.0000 -10.0000 0.0000 "
            "center 60.0000 -30.0000 0.0000 sweep 270.0000\n"
            "- retract line 60.0000 -10.0000 0.0000 -> 60.0000 50.0000 0.0000\n");
}

// Third and tracking axes end where their block ends, though it is longer or shorter than
// programmed; what is inserted stands still. Split, they are divided by length.
TEST(OtherAxes, TravelWithTheirBlock) {  // D-26
  const ProgramRun run = to_blocks(
      "G0 X0 Y0 Z0 A0 F100\nG26 V.G.WZ_AKT.R=5\n#TRC[SPLIT_PATH DIST_SEG1=5 FEED_SEG1=50]\n"
      "G41 G1 X0 Y25 Z-10 A20\nX40 Z-20 A50\nY-30 Z-30 A80\nG40 Y-50 Z0 A0\nM30\n");
  ASSERT_FALSE(run.stopped) << run.codes();
  std::string text;
  for (const CompensatedBlock& block : run.blocks) {
    if (block.origin == Origin::passthrough) continue;
    const auto round = [](double value) { return std::to_string(std::lround(value * 1000)); };
    text += round(block.normal.to) + ' ' + round(block.tracking.at(0).to) + "; ";
  }
  // Approach to Q = (-5, 25) of √650 mm: β 270 is an outside corner, so it is not split.
  EXPECT_EQ(text,
            "0 0; -10000 20000; -10000 20000; -20000 50000; -20000 50000; -30000 80000; "
            "0 0; ");
}

// After a change of side as after an approach: the line with G42 ends beside the contour with the
// old radius.
TEST(RadiusChangeAtOnce, FollowsAChangeOfSide) {  // D-21
  const std::string begin =
      "G0 X0 Y-10 F800\nV.G.WZ_AKT.R=5\n#TRC[PERPENDICULAR_RADIUS_CHANGE=1]\nG138 G41 G1 X0 Y0\n"
      "X50\nG42 X100\nV.G.WZ_AKT.R=8\n";
  const ProgramRun run = to_text(begin + "X150\nY50\nG40 X180\nM30\n");
  EXPECT_NE(run.text.find("G01 X100 Y-5\nG01 X100 Y-8\nG01 X158 Y-8\n"), std::string::npos)
      << run.text;
}

// D-30: what TRC inserts has the feed of the block before it under G10 and G11 alike; only
// arcs of the program are adapted: 600 · 15 / 10 outside, 600 · 5 / 10 inside.
TEST(InsertedBlocks, HaveTheProgrammedFeedUnderG11) {
  for (const char* head : {"G26 G11", "G25 G11", "G26 G11\n#TRC[PERPENDICULAR_RADIUS_CHANGE=1]"}) {
    const ProgramRun run = to_blocks(
        "G0 X0 Y0\nV.G.WZ_AKT.R=5\n" + std::string(head) +
        "\nN1 G41 G1 X20 F600\nN2 X60\nN3 Y-30 F300\nN4 G2 X50 Y-40 I-10\nN5 G1 X20 F600\n"
        "N6 G2 X10 Y-30 J10\nV.G.WZ_AKT.R=6\nN7 G1 Y-20\nN8 G40 Y-10\nM30\n");
    ASSERT_FALSE(run.stopped) << run.codes();
    std::size_t inserted = 0;
    for (const CompensatedBlock& block : run.blocks) {
      const std::int64_t line = block.source.number;
      if (line < 1 || block.origin == Origin::passthrough) continue;
      const double programmed = line == 3 || line == 4 ? 300 : 600;
      const bool own_arc = block.origin == Origin::programmed && is_arc(block.path);
      EXPECT_NEAR(block.feed, programmed * (own_arc ? 1.5 : 1), 1e-9) << head << " N" << line;
      inserted += block.origin == Origin::transition || block.origin == Origin::radius_change;
    }
    EXPECT_EQ(inserted, std::string(head).starts_with("G25") ? 0U
                        : std::string(head).ends_with("=1]") ? 2U
                                                             : 1U)
        << head;
  }
}

// D-33: neither G141 nor G140 touches KERF_MASKING, and G141 moves no point of a notch.
TEST(ContourMaskingFunction, DoesNotSwitchKerfMasking) {
  for (const bool kerf : {false, true})
    for (const Masking masking : {Masking::on, Masking::off}) {
      std::vector<Block> blocks;
      Diagnostics diagnostics;
      ProgramState state({}, {}, diagnostics, blocks);
      TrcOptions options;
      options.kerf_masking = kerf;
      ASSERT_TRUE(state.set_options(options, {}));
      ASSERT_TRUE(state.set_masking(Masking::on, {}));
      ASSERT_TRUE(state.set_masking(masking, {}));
      EXPECT_EQ(state.mode().options.kerf_masking, kerf);
    }
  // A notch of 60 degrees: the inside corner is cut back by R / tan 30°, nothing else.
  const std::string notch = "G41 G1 X20\nX60\nX40 Y34.641016\nX-20\nG40 X-60";
  const std::string expected =
      "- approach line 0.0000 0.0000 0.0000 -> 20.0000 5.0000 0.0000\n"
      "- programmed line 20.0000 5.0000 0.0000 -> 51.3397 5.0000 0.0000\n"
      "- programmed line 51.3397 5.0000 0.0000 -> 37.1132 29.6410 0.0000\n"
      "- programmed line 37.1132 29.6410 0.0000 -> -20.0000 29.6410 0.0000\n"
      "- retract line -20.0000 29.6410 0.0000 -> -60.0000 34.6410 0.0000\n";
  EXPECT_EQ(path_of(program_of("X0 Y0", "G140", notch)), expected);
  EXPECT_EQ(path_of(program_of("X0 Y0", "G141", notch)), expected);
}

// Every rule that holds a selection back names the limit that it passes.
TEST(SelectionTooLong, NamesItsLimit) {  // 900212
  const std::string contour = "G41 G1 X10\nX20\nX30\nX40\nX50\nG40 X60";
  for (const char* held_by : {"G238", "G141", "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]", ""}) {
    // Verification cannot hold it either, and does not report that a second time.
    for (const Verify verify : {Verify::off, Verify::report, Verify::enforce}) {
      ProgramSessionSetup setup;
      setup.session.verify = verify;
      setup.session.compensator.limits.selection_blocks = 3;
      setup.session.compensator.implicit_contour_masking = held_by[0] == '\0';
      const ProgramRun run = to_blocks(program_of("X0 Y0", held_by, contour), setup);
      ASSERT_EQ(run.diagnostics.size(), 1U) << held_by;
      EXPECT_EQ(run.diagnostics[0].code, Code::selection_too_long) << held_by;
      EXPECT_EQ(run.diagnostics[0].severity, Severity::error) << held_by;
      ASSERT_EQ(run.diagnostics[0].values.size(), 1U) << held_by;
      EXPECT_EQ(run.diagnostics[0].values[0].name, "limit");
      EXPECT_EQ(run.diagnostics[0].values[0].value, 3);
    }
  }
}

// The parameters the reference control publishes with its messages.
TEST(PublishedValues, ComeWithTheirMessage) {
  const auto values = [](const std::string& program) {
    const ProgramRun run = to_blocks(program);
    std::string text;
    if (run.diagnostics.size() != 1) return text;
    std::map<std::string, double> named;
    for (const DiagnosticValue& value : run.diagnostics[0].values)
      named[std::string(value.name)] = value.value;
    for (const auto& [name, value] : named) {
      std::string number;
      append_fixed(number, value, 3);
      text += name + ' ' + number + "; ";
    }
    return std::to_string(static_cast<int>(run.diagnostics[0].code)) + ": " + text;
  };
  // Up between two lines at 45 degrees each: 10 tan 22.5° is cut at either end.
  EXPECT_EQ(
      values(program_of("X-30 Y0", "V.G.WZ_AKT.R=10", "G41 G1 X0 Y0\nX50\nX55 Y5\nY50\nG40 Y80")),
      "90019: compensated_length -1.213; largest_radius 8.535; programmed_length 7.071; "
      "tool_radius 10.000; ");
  EXPECT_EQ(values(program_of("X-30 Y0", "V.G.WZ_AKT.R=12",
                              "G41 G1 X0 Y0\nX50\nG3 X60 Y10 J10\nG1 Y50\nG40 Y80")),
            "90017: contour_radius 10.000; difference -2.000; smallest_difference 0.000; "
            "tool_radius 12.000; ");
  EXPECT_EQ(values(program_of("X0 Y0", "N70 G238 V.G.WZ_AKT.R=12",
                              "N80 G41 G1 X-10 Y-10\nN90 X10\nY10\nX-10\nY-10\nG40 X0 Y0")),
            "90123: distance 10.000; selection_block 80.000; tool_radius 12.000; ");
  // Without a number it is named by its line.
  EXPECT_EQ(values(program_of("X0 Y0", "G238 V.G.WZ_AKT.R=12",
                              "G41 G1 X-10 Y-10\nX10\nY10\nX-10\nY-10\nG40 X0 Y0")),
            "90123: distance 10.000; selection_index 3.000; selection_line 4.000; "
            "tool_radius 12.000; ");
}

}  // namespace
}  // namespace trc::support
