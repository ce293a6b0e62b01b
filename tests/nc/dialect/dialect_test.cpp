#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/nc/dialect/reading.h"

namespace trc::testing {
namespace {

constexpr double pi = std::numbers::pi;

Line last_line(const Reading& reading) {
  const MotionBlock motion = reading.last_motion();
  const Line* line = std::get_if<Line>(&motion.path);
  EXPECT_NE(line, nullptr);
  return line == nullptr ? Line{} : *line;
}

Arc last_arc(const Reading& reading) {
  const MotionBlock motion = reading.last_motion();
  const Arc* arc = std::get_if<Arc>(&motion.path);
  EXPECT_NE(arc, nullptr);
  return arc == nullptr ? Arc{} : *arc;
}

TEST(Dialect, TheSampleOfTheManualIsRead) {
  const Reading reading = read(
      "%G239_Demo1.nc\n"
      "N010 G0 X0 Y0 Z0 F1000\n"
      "N020 G239 (TRC mode)\n"
      "N030 V.G.WZ_AKT.R = 10\n"
      "N040 G41 G01 X30 Y20 (Select TRC)\n"
      "N050 G01 X60\n"
      "N080 G40 (Deselect TRC without block)\n"
      "N100 G00 X150 Y0\n"
      "N110 M30\n");
  EXPECT_TRUE(reading.diagnostics.empty());
  const auto motions = reading.motions();
  ASSERT_EQ(motions.size(), 3U);
  EXPECT_EQ(motions[0].source, (Source{.index = 3, .number = 40, .line = 5}));
  EXPECT_EQ(motions[0].mode->selection, Selection::without_block);
  EXPECT_EQ(motions[0].mode->side, Side::left);
  EXPECT_EQ(motions[0].mode->tool_radius, 10);
  EXPECT_EQ(motions[0].feed, 1000);
  EXPECT_EQ(std::get<Line>(motions[2].path), (Line{.start = {60, 30}, .end = {150, 0}}));
  EXPECT_TRUE(motions[2].rapid);
}

TEST(Dialect, TheOrderOfWordsWithinABlockDoesNotMatter) {
  for (const char* block : {"G91 G01 X5 Y5 F100", "X5 F100 Y5 G01 G91", "F100 X5 G91 Y5 G01"}) {
    const Reading reading = read(std::string("G0 X10 Y10\n") + block);
    EXPECT_EQ(last_line(reading), (Line{.start = {10, 10}, .end = {15, 15}})) << block;
    EXPECT_EQ(reading.last_motion().feed, 100);
  }
}

TEST(Dialect, MotionFunctionsAreModal) {
  EXPECT_EQ(last_line(read("G01 X1 F5\nG90\nX2")), (Line{.start = {1, 0}, .end = {2, 0}}));
  EXPECT_FALSE(read("G01 X1 F5\nX2").last_motion().rapid);
  EXPECT_TRUE(read("X2").last_motion().rapid) << "G00 is the initial state";
}

TEST(Dialect, AFunctionIsItsNumberAndNoneCloseToIt) {
  const Dialect& fanuc = dialect_of(DialectName::fanuc);
  EXPECT_NE(fanuc.function(41), nullptr);
  EXPECT_NE(fanuc.function(54.1), nullptr);
  for (const double number : {40.9999999, 41.0000001, 54.15, -41.0}) {
    SCOPED_TRACE(number);
    EXPECT_EQ(fanuc.function(number), nullptr);
  }
}

TEST(Dialect, DimensionsMayBeIncremental) {
  EXPECT_EQ(last_line(read("G00 X10\nG91 X5 Y2\nX1")), (Line{.start = {15, 2}, .end = {16, 2}}));
}

TEST(Dialect, G70CountsInInchWhatIsALength) {
  const Reading reading = read("G70 G01 X1 Y2 F10\nV.G.WZR=0.5\nG41 X3\nX4");
  EXPECT_EQ(last_line(reading), (Line{.start = {3 * 25.4, 2 * 25.4}, .end = {4 * 25.4, 2 * 25.4}}));
  EXPECT_EQ(reading.last_motion().feed, 254);
  EXPECT_EQ(reading.last_motion().mode->tool_radius, 12.7);
  EXPECT_EQ(last_line(read("G70 X1\nG71 X1")).end, Point(1, 0));
}

TEST(Dialect, G70CountsCirclesInInchButDegreesAsTheyAre) {
  const Reading reading = read("G70 G03 X2 I1 A90 U1");
  EXPECT_EQ(last_arc(reading).center, Point(25.4, 0));
  const auto tracking = reading.last_motion().tracking;
  ASSERT_EQ(tracking.size(), 6U);
  EXPECT_EQ(tracking[0].to, 90);
  EXPECT_EQ(tracking[3].to, 25.4);
}

TEST(Dialect, CentresAreRelativeUnlessG161SaysAbsolute) {
  EXPECT_EQ(last_arc(read("G00 X10 Y0\nG03 X30 Y0 I10")).center, Point(20, 0));
  EXPECT_EQ(last_arc(read("G161 G00 X10 Y0\nG03 X30 Y0 I20 J0")).center, Point(20, 0));
}

TEST(Dialect, ACircleWithoutEndPointIsFull) {
  const Arc arc = last_arc(read("G00 X10 Y5\nG02 I5"));
  EXPECT_EQ(arc.sweep, -2 * pi);
  EXPECT_EQ(arc.center, Point(15, 5));
}

TEST(Dialect, AHelixTravelsAcrossThePlane) {
  // The example of the manual: one turn about the zero point up to Z20.
  const Reading reading = read("G17 G90 X-10 Y0 Z0 F500 G161\nG03 I0 J0 Z20");
  EXPECT_EQ(last_arc(reading).sweep, 2 * pi);
  EXPECT_EQ(reading.last_motion().normal, (AxisTravel{.from = 0, .to = 20}));
}

// As programs of CAM systems have it that write all three words.
TEST(Dialect, ACentreMayHaveNothingAcrossThePlane) {
  EXPECT_EQ(last_arc(read("G17 X0 Y0 Z7\nG02 X10 I5 J0 K0")).center, Point(5, 0));
  const std::string contour = "G17 X0 Y0 Z7\nG41 G01 X10\nG02 X20 I5 J0 ";
  EXPECT_EQ(last_arc(read(contour + "K0")).center, Point(15, 0));
  EXPECT_EQ(read(contour + "K7").code(), Code::nc_unsupported);
}

TEST(Dialect, ARadiusWordGivesTheShorterOrTheLongerArc) {
  EXPECT_NEAR(last_arc(read("G02 X10 R10")).sweep, -pi / 3, 1e-12);
  EXPECT_NEAR(last_arc(read("G02 X10 R-10")).sweep, -5 * pi / 3, 1e-12);
}

TEST(Dialect, CirclesRunInAllPlanes) {
  const Reading zx = read("G18 G03 X10 Z-10 K-10");
  EXPECT_NEAR(last_arc(zx).sweep, pi / 2, 1e-12);
  EXPECT_EQ(last_arc(zx).end, Point(-10, 10));
  const Reading yz = read("G19 G02 Y10 Z10 J10");
  EXPECT_NEAR(last_arc(yz).sweep, -pi / 2, 1e-12);
}

TEST(Dialect, TechnologyPassesInItsPlaceAndItsText) {
  const Reading reading =
      read("T1 M6\nS1000 m03\nG01 X10 F100 M8\nH5 ( cool )\n#TIME 2.5\nG60 G359\nM30");
  EXPECT_EQ(reading.technology(), (std::vector<std::string>{"T1 M6", "S1000 m03", "M8", "H5",
                                                            "#TIME 2.5", "G60 G359", "M30"}));
}

TEST(Dialect, TechnologyOfAMotionLineActsBeforeTheMotionAndAStopAfterIt) {
  const Reading reading = read("N5 G01 X10 M8 M0 F1");
  ASSERT_EQ(reading.blocks.size(), 3U);
  EXPECT_EQ(std::get<PassiveBlock>(reading.blocks[0]).text, "M8");
  EXPECT_TRUE(std::holds_alternative<MotionBlock>(reading.blocks[1]));
  EXPECT_EQ(std::get<PassiveBlock>(reading.blocks[2]).text, "M0");
  for (const Block& block : reading.blocks)
    EXPECT_EQ(std::visit([](const auto& b) { return b.source.number; }, block), 5);
}

TEST(Dialect, TheAxisLetterOfADwellIsATime) {
  for (const char* dwell : {"G04 X2.5", "G4 2.5", "G04 S10", "N10 G04 X=2.5 (wait)"}) {
    const Reading reading = read(std::string("G00 X7\n") + dwell + "\nX8");
    EXPECT_TRUE(reading.diagnostics.empty()) << dwell;
    EXPECT_EQ(last_line(reading), (Line{.start = {7, 0}, .end = {8, 0}})) << dwell;
    EXPECT_EQ(reading.technology().size(), 1U) << dwell;
  }
}

TEST(Dialect, ABlockMayBeContinuedOnTheNextLine) {
  const Reading reading = read("N10 G60 G90 F1000 G01 \\\nN20 X100 Y150\nN30 X0");
  const auto motions = reading.motions();
  ASSERT_EQ(motions.size(), 2U);
  EXPECT_EQ(motions[0].source, (Source{.index = 0, .number = 10, .line = 1}));
  EXPECT_EQ(std::get<Line>(motions[0].path).end, Point(100, 150));
  EXPECT_EQ(motions[1].source, (Source{.index = 1, .number = 30, .line = 3}));
  EXPECT_EQ(reading.lines.size(), 2U);
}

TEST(Dialect, AProgramEndsWithM30AndKeepsTheRestAsText) {
  const std::string text = "G00 X1\nM30\n$IF garbage X[\n\x04\n%next\n";
  const Reading reading = read(text);
  EXPECT_TRUE(reading.diagnostics.empty());
  EXPECT_EQ(reading.motions().size(), 1U);
  EXPECT_EQ(reading.text(), text);
  EXPECT_TRUE(reading.lines[1].ends_program);
  EXPECT_FALSE(reading.lines[2].has_words);
}

TEST(Dialect, M02EndsAfterTheMotionOfItsLine) {
  const Reading reading = read("G00 X1 M02\nX2");
  EXPECT_EQ(reading.motions().size(), 1U);
}

TEST(Dialect, CommentsAndBlankLinesAreNoBlocks) {
  const Reading reading = read("; head\n\n(a)\nG00 X1\n");
  EXPECT_EQ(reading.last_motion().source, (Source{.index = 0, .line = 4}));
  EXPECT_FALSE(reading.lines[0].has_words);
}

TEST(Dialect, ACommentMayReachOverManyLines) {
  const std::string text = "G00 X1\n#COMMENT BEGIN\nX2 garbage [\n#COMMENT END (x)\nX3\n";
  const Reading reading = read(text);
  EXPECT_TRUE(reading.diagnostics.empty());
  EXPECT_EQ(reading.motions().size(), 2U);
  EXPECT_EQ(reading.text(), text);
}

TEST(Dialect, EveryLineEndAndAByteOrderMarkAreReadAndKept) {
  for (const char* text :
       {"\xEF\xBB\xBFG00 X1\r\nX2\r\nX3", "G00 X1\rX2\rX3\r", "G00 X1\nX2\r\nX3\rX4\n\r\n"}) {
    const Reading reading = read(text);
    EXPECT_TRUE(reading.diagnostics.empty()) << text;
    EXPECT_EQ(reading.text(), text);
    EXPECT_GE(reading.motions().size(), 3U);
    EXPECT_EQ(reading.motions()[2].source.line, 3U);
  }
}

TEST(Dialect, AProgramNameIsNotContinued) {
  for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
    const Reading reading = read(mark + "%C:\\\nG00 X1\n");
    EXPECT_EQ(reading.motions().size(), 1U);
    EXPECT_EQ(reading.last_motion().source.line, 2U);
  }
}

TEST(Dialect, AContinuedFirstLineMayHaveAByteOrderMark) {
  const std::string text = "\xEF\xBB\xBFG00 \\\nX1\n";
  const Reading reading = read(text);
  EXPECT_TRUE(reading.diagnostics.empty());
  EXPECT_EQ(reading.text(), text);
  EXPECT_EQ(reading.lines.size(), 2U);
}

TEST(Dialect, WordRolesTellTheWriterWhatIsWhat) {
  const Reading reading = read("N10 G17 G41 G01 X10 I5 F100 M8 M0 (c)");
  ASSERT_EQ(reading.lines.size(), 1U);
  const ProgramLine& line = reading.lines[0];
  std::string roles;
  for (const WordRange& word : line.words) {
    constexpr std::string_view letters = "NGXTmFMS(";
    roles +=
        std::string(line.word(word)) + ":" + letters[static_cast<std::size_t>(word.role)] + " ";
  }
  EXPECT_EQ(roles, "N10:N G17:m G41:T G01:G X10:X I5:X F100:F M8:M M0:S (c):( ");
}

TEST(Dialect, LinesCarryTheModesInForceAfterThem) {
  const Reading reading = read("G00 X1\nG91 G70 G161 G18 F1\nG01 Z1\n");
  ASSERT_EQ(reading.lines.size(), 3U);
  EXPECT_FALSE(reading.lines[0].incremental);
  const ProgramLine& line = reading.lines[2];
  EXPECT_TRUE(line.incremental && line.unit == LengthUnit::inch && line.absolute_center);
  EXPECT_EQ(line.plane, Plane::zx);
  EXPECT_EQ(line.motion, MotionKind::linear);
  EXPECT_EQ(line.feed, 25.4);
  EXPECT_TRUE(line.is_motion);
  EXPECT_FALSE(reading.lines[1].is_motion);
}

TEST(Dialect, TrackingAxesAreThoseOfTheSetup) {
  const Reading reading = read("G01 X1 C1=90 a5", {.tracking_axes = {"A", "C1"}});
  EXPECT_EQ(reading.last_motion().tracking,
            (TrackingTravel{{.from = 0, .to = 5}, {.from = 0, .to = 90}}));
}

TEST(Dialect, DWordsTakeTheRadiusOfTheToolTable) {
  const ProgramSetup setup{.tools = {{1, 5}, {2, -3}}};
  EXPECT_EQ(read("D1\nG41 X1", setup).last_motion().mode->tool_radius, 5);
  const Reading negative = read("D2\nG41 X1", setup);
  EXPECT_EQ(negative.last_motion().mode->tool_radius, 3);
  EXPECT_EQ(negative.last_motion().mode->side, Side::right);
  const Reading none = read("D1\nD0\nG41 X1", setup);
  ASSERT_FALSE(none.diagnostics.empty());
  EXPECT_EQ(none.diagnostics.back().code, Code::no_tool_radius);
}

TEST(Dialect, ZeroShiftsPassWhileTrcIsOff) {
  const Reading reading = read("G54\nG00 X1 Y2\nG159=3 X5 Y6\nG92 X0 Y0\nX1 Y1");
  EXPECT_TRUE(reading.diagnostics.empty());
  EXPECT_EQ(reading.technology(), (std::vector<std::string>{"G54", "G159=3", "G92 X0 Y0"}));
  EXPECT_EQ(last_line(reading), (Line{.start = {5, 6}, .end = {1, 1}}));
}

TEST(Dialect, FIsNoFeedPerMinuteUnderG95) {
  const Reading reading = read("G95 F0.2\nG01 X1\nG94 F100 X2");
  EXPECT_EQ(reading.motions()[0].feed, 0);
  EXPECT_EQ(reading.technology()[0], "G95 F0.2");
  EXPECT_EQ(reading.motions()[1].feed, 100);
}

TEST(Dialect, TrcModesOfOneBlockAllActOnItsMotion) {
  const Reading reading = read("V.G.WZR=3\nG42 G138 G26 G141 G11 G01 X10 Y5 F100\nX20\nG40");
  const TrcMode& mode = *reading.last_motion().mode;
  EXPECT_EQ(mode.side, Side::right);
  EXPECT_EQ(mode.selection, Selection::direct);
  EXPECT_EQ(mode.transition, Transition::circular);
  EXPECT_EQ(mode.masking, Masking::on);
  EXPECT_EQ(mode.feed_adaptation, FeedAdaptation::on);
}

TEST(Dialect, TrcCommandsActFromTheirLineOn) {
  const Reading reading =
      read("#TRC [STRETCH_FACTOR=3]\n#TANGFEED [RMIN=2]\nX1\n#TRC[REVERSE=1]\nX2");
  EXPECT_EQ(reading.motions()[0].mode->options, (TrcOptions{.stretch_factor = 3}));
  EXPECT_EQ(reading.motions()[0].mode->tangfeed_minimum, 2);
  EXPECT_EQ(reading.motions()[1].mode->options, (TrcOptions{.reverse = true, .stretch_factor = 3}));
}

TEST(Dialect, TheSameTextInLowerCaseMeansTheSame) {
  const Reading upper = read("N10 G01 X10 Y5 F100\nN20 G02 X20 I5");
  const Reading lower = read("n10 g01 x10 y5 f100\nn20 g02 x20 i5");
  EXPECT_EQ(last_arc(upper), last_arc(lower));
}

}  // namespace
}  // namespace trc::testing
