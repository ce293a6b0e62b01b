#include <gtest/gtest.h>

#include <ostream>

#include "core/messages/diagnostic_text.h"
#include "tests/nc/dialect/reading.h"

namespace trc::testing {
namespace {

// The mode errors of T-22 and G303 after G40 (T-20) are among them; each also has
// a program in tests/programs/bad.
struct Refused {
  const char* name;
  const char* text;
  const char* place_and_code;  // of the last diagnostic
};

std::ostream& operator<<(std::ostream& out, const Refused& refused) { return out << refused.text; }

class Refusal : public ::testing::TestWithParam<Refused> {};

TEST_P(Refusal, NamesPlaceAndCode) {
  const ProgramSetup setup{.tools = {{1, 5}, {2, 6}}};
  const Reading reading = read(GetParam().text, setup);
  ASSERT_FALSE(reading.diagnostics.empty());
  EXPECT_EQ(place_and_code(reading.diagnostics.back()), GetParam().place_and_code)
      << message_of(reading.diagnostics.back());
  EXPECT_TRUE(reading.stopped);
}

const auto named = [](const auto& tested) { return std::string(tested.param.name); };

INSTANTIATE_TEST_SUITE_P(
    OfABlock, Refusal,
    ::testing::Values(Refused{"TwoMotionFunctions", "G00 X1\nG01 X2 G00 Y5", "2:8 900012"},
                      Refused{"TheSameMotionFunctionTwice", "G01 X2 G01", "1:8 900012"},
                      Refused{"AMotionAfterAnAssignment", "V.P.A=5 G01 X100 Y50", "1:1 900003"},
                      Refused{"AMotionCloseAfterAnAssignment", "V.L.A=5X9", "1:1 900003"},
                      Refused{"ACallAfterAnAssignment", "V.P.A=P1 L SUB", "1:1 900003"},
                      Refused{"ACommandAfterAnAssignment", "V.S.A = 1 #TRC [KERF_MASKING=1]",
                              "1:1 900003"},
                      Refused{"TwoPlanes", "G17 G18", "1:5 900012"},
                      Refused{"TwoDimensions", "G90 G91 X1", "1:5 900012"},
                      Refused{"TwoUnits", "G70 X100 G71", "1:10 900012"},
                      Refused{"TwoCentreModes", "G161 G162", "1:6 900012"},
                      Refused{"TwoCentreCorrections", "G165 G02 I10 X20 G164", "1:18 900012"},
                      Refused{"TwoFeedAdaptations", "G10 G11", "1:5 900012"},
                      Refused{"TwoMaskings", "G140 G141", "1:6 900012"},
                      Refused{"TwoSides", "G41 X10 Y20 G42", "1:13 20114"},
                      Refused{"TwoSelectionModes", "G138 G41 G139", "1:10 20126"},
                      Refused{"TwoTransitionTypes", "G25 G26", "1:5 20113"},
                      Refused{"AnAxisTwice", "X10 Y20 X10", "1:9 900010"},
                      Refused{"ACentreWordTwice", "G02 I10 I20", "1:9 900010"},
                      Refused{"ARadiusWordTwice", "G02 X1 R10 R20", "1:12 900010"},
                      Refused{"AFeedTwice", "F1 X1 F2", "1:7 900010"},
                      Refused{"ABlockNumberTwice", "N20 X10 N30", "1:9 900010"},
                      Refused{"AToolTwice", "D1 D2", "1:4 900010"},
                      Refused{"ToolAndRadius", "D1 V.G.WZ_AKT.R=3", "1:4 20083"},
                      Refused{"RadiusAndTool", "V.G.WZ_AKT.R=3 D1", "1:16 20083"},
                      Refused{"AnUnknownFunction", "G999 X1", "1:1 900002"},
                      Refused{"AFunctionWithADecimalPoint", "G55.5", "1:1 900002"},
                      Refused{"AnUnknownAxis", "X1 Q5", "1:4 900011"},
                      Refused{"AnUnknownAxisWithAName", "X1=5", "1:1 900011"},
                      Refused{"ANumberWithoutLetter", "G01 10", "1:5 900001"},
                      Refused{"ASignThatIsNoWord", "X1 !", "1:4 900001"},
                      Refused{"ABlockNumberThatIsNone", "N1.5 X1", "1:1 900008"},
                      Refused{"ANegativeFeed", "G01 X1 F-5", "1:8 900008"},
                      Refused{"AFeedOfZero", "G01 X1 F0", "1:8 900008"},
                      Refused{"AFeedOfZeroWithDecimals", "G95 F0\nG94 X1\nF0.0 X2", "3:1 900008"},
                      Refused{"AFeedOutOfRange", "F1000000000\nX1 F1000000001", "2:4 900008"},
                      Refused{"AFeedOutOfRangeInInch", "G70 X1 F39370079", "1:8 900008"},
                      Refused{"ASplitFeedOutOfRange",
                              "#TRC [SPLIT_PATH DIST_SEG1=5 FEED_SEG1=1000000001]", "1:30 900005"},
                      Refused{"AnEWord", "G01 X1 E5", "1:8 900003"},
                      Refused{"AWordBesideACommand",
                              "#TRC [REVERSE=1]\n#MSG [\"x\"]\nG01 #TRC [REVERSE=1]", "3:5 900001"},
                      Refused{"G05Alone", "G05 X1", "1:1 900001"},
                      Refused{"ADwellWithAMotion", "G01 G04 X1", "1:5 900001"},
                      Refused{"ADwellWithTechnology", "G04 X1 M8", "1:1 900001"},
                      Refused{"ADwellWithoutTime", "G04", "1:1 900008"},
                      Refused{"AFaultInAContinuedLine", "G01 X1 \\\n  Y", "2:3 900008"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    OfAProgram, Refusal,
    ::testing::Values(
        Refused{"AVariableInAWord", "X1\nX=V.L.A", "2:1 900003"},
        Refused{"AVariableOfTheControl", "X1\nV.G.A=5", "2:1 900003"},
        Refused{"AParameter", "P5", "1:1 900003"},
        Refused{"AnExpression", "G01 X[1+2]", "1:5 900003"},
        Refused{"AControlStatement", "$IF 1", "1:1 900003"},
        Refused{"ASideInASubprogram", "%L SUB\nN1 G41 X1\nM29\n%MAIN\nX1", "2:4 900003"},
        Refused{"ASubprogramAlone", "%L SUB\nX1\nM29\n", "3:0 900014"},
        Refused{"ASubprogramAfterTheProgram", "X1\n%L SUB\nM29\n", "2:1 900003"},
        Refused{"AMotionOfAnotherDialect", "L X+10", "1:1 900016"},
        Refused{"AMotionOfAnotherDialectWithoutASign", "L X10", "1:1 900003"},
        Refused{"TwoNames", "X1\nL SUB TWO", "2:1 900003"},
        Refused{"PointToPoint", "#PTP ON", "1:1 900003"},
        Refused{"ARealTimeLoop", "#RT WHILE", "1:1 900003"},
        Refused{"ASubprogramEnd", "X1\nM17", "2:1 900003"},
        Refused{"ABlockToSkip", "/N10 X1", "1:1 900017"},
        Refused{"ASecondProgram", "X1\n%two\n", "2:1 900003"},
        Refused{"Mirroring", "G22 X1", "1:1 900003"},
        Refused{"ContourRotation", "G68 X1", "1:1 900003"},
        Refused{"Splines", "G151", "1:1 900003"},
        Refused{"Chamfers", "G41 G01 X0 Y10\nG301 I5", "2:1 900003"},
        Refused{"HomingWithinAContour", "G41 G01 X0 Y10\nG74 X1", "2:1 900003"},
        Refused{"RadiusProgramming", "G163", "1:1 900003"},
        Refused{"AnUnknownCommand", "#OTC ON", "1:1 900003"},
        Refused{"AxisWeightsWithAMotion", "G01 G130 X50", "1:5 900003"},
        Refused{"APresetWithAMotion", "G92 G01 X0", "1:1 900003"},
        Refused{"AnOpenBracket", "#TRC [REVERSE=1", "1:6 900009"},
        Refused{"ALineContinuedToNothing", "X1\nX2 \\", "2:0 900009"},
        Refused{"ALineContinuedToTheEnd", "X1\nX2 \\\n", "2:0 900009"},
        Refused{"AnOpenCommentBlock", "X1\n#COMMENT BEGIN\nX2\n", "2:0 900009"},
        Refused{"ANestedCommentBlock", "#COMMENT BEGIN\n#COMMENT BEGIN\n", "2:1 900003"},
        Refused{"NoBlockAtAll", "%name\n; nothing\n\n", "3:0 900014"},
        Refused{"NoTextAtAll", "", "1:0 900014"},
        Refused{"AnUnknownTool", "D99\nG41 G01 X9", "1:1 900013"},
        Refused{"ARadiusOutOfRange", "V.G.WZ_AKT.R=300000", "1:1 900104"},
        Refused{"ACoordinateOutOfRange", "G01 Y3 X1000001", "1:5 90134"},
        Refused{"AStartThatIsUnknown", "G54\nG91 X1", "2:5 900106"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    OfACircle, Refusal,
    ::testing::Values(Refused{"AFullCircleWithARadius", "G02 X0 Y0 R10", "1:5 20034"},
                      Refused{"ARadiusAlone", "G02 R10", "1:5 20034"},
                      Refused{"ACentreThatDoesNotFit", "G02 X10 I2 J7", "1:5 20035"},
                      Refused{"ARadiusThatIsTooSmall", "G02 X100 R20", "1:5 20035"},
                      Refused{"ACentreOnTheStart", "G02 X10 I0 J0", "1:9 20036"},
                      Refused{"NoCentreUnderG164", "G164 G02 X10", "1:10 20036"},
                      Refused{"CentreAndRadius", "G02 X200 I50 J50 R50", "1:10 21024"},
                      Refused{"RadiiThatDifferUnderG164", "G164 G02 X10 I4", "1:10 21758"},
                      Refused{"NeitherCentreNorRadius", "G02 X10", "1:5 900101"},
                      Refused{"AHeightAloneUnderAModalCircle", "G02 X10 I5\nZ5", "2:1 900101"},
                      Refused{"APitch", "G41 G01 X5\nG02 X15 I5 Z10 K2", "2:5 900003"},
                      Refused{"ACentreUnderG01", "G01 X10 I5", "1:5 900003"},
                      Refused{"ARadiusUnderG01", "G01 X10 R5", "1:5 900003"},
                      Refused{"ACentreOutOfRange", "G02 X1 I2000000", "1:8 90133"},
                      Refused{"ARadiusWithACentreOutOfRange", "G02 X1 R2000000", "1:8 90133"},
                      Refused{"ASpiralUnderTrc", "V.G.WZR=1\nG41 G01 X10\nG164 G03 X0 Y10.05 I-10",
                              "3:10 90018"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    WhileTrcIsActive, Refusal,
    ::testing::Values(Refused{"APlaneChange", "G41 X1\nX2\nG19", "3:1 20133"},
                      Refused{"APlaneChangeBeforeTheRetract", "G41 X1\nX2\nG40\nG18", "4:1 20133"},
                      Refused{"AZeroShift", "G41 X1\nG54", "2:1 900003"},
                      Refused{"AZeroShiftBeforeTheRetract", "G41 X1\nX2\nG40\nG54", "4:1 900003"},
                      Refused{"ACoordinateSystem", "G41 X1\n#CS ON", "2:1 20802"},
                      Refused{"ASubprogramCall", "G41 X1\nL SUB", "2:1 900003"},
                      Refused{"AVariable", "G41 X1\nV.P.A=1", "2:1 900003"},
                      Refused{"ATransformation", "G41 X1\n#RTCP ON", "2:1 900003"},
                      Refused{"AnAxisCoordinateSystem", "G41 X1\n#ACS ON", "2:1 20802"},
                      Refused{"MachineCoordinates", "G41 X1\n#MCS ON", "2:1 20802"},
                      Refused{"AnAxisLink", "G41 X1\n#AX LINK ON ALL", "2:1 20457"},
                      Refused{"AnAxisLinkEnabled", "G41 X1\n#ENABLE AX LINK", "2:1 20457"},
                      Refused{"APreset", "G41 X1\n#PSET X0", "2:1 20608"},
                      Refused{"ASecondPreset", "G41 X1\n#PRESET [X0]", "2:1 20608"},
                      Refused{"PointToPoint", "G41 X1\n#PTP ON", "2:1 21525"},
                      Refused{"TheEndOfPointToPoint", "G41 X1\n#PTP OFF", "2:1 21525"},
                      Refused{"ARealTimeLoop", "G41 X1\n#RT WHILE TRUE", "2:1 22158"},
                      Refused{"AChangeToG238", "G41 X1\nG238", "2:1 21317"},
                      Refused{"AChangeFromG238", "G238 G41 X1\nG139", "2:1 21318"},
                      Refused{"ARadiusChangeUnderG238", "G238 D1 G41 X1\nD2 X2", "2:1 90127"},
                      Refused{"ABlockTimeAsFeed", "G93 F5\nG41 X1", "2:5 900003"},
                      Refused{"AdaptedFeedPerRevolution", "G95 F5 G11\nG41 X1", "2:5 900003"}),
    named);

INSTANTIATE_TEST_SUITE_P(
    OfTheTrcSequence, Refusal,
    ::testing::Values(
        Refused{"ASelectionAfterG40WithoutMotion", "G41 X1\nX2\nG40\nZ5\nG42", "5:1 900103"},
        Refused{"G303AfterG40", "G42 G139\nG01 X10 Y10\nX20\nG40\nG303 X1", "5:1 90193"},
        Refused{"G303AsSuch", "G42 G139\nG01 X10 Y10\nX20\nG40 X20 Y20\nG303 X1", "5:1 900003"},
        Refused{"InverseWithoutOnline", "#TRC [INVERSE=1]", "1:1 22125"},
        Refused{"ANegativeMinimum", "#TANGFEED [RMIN=-1]", "1:1 20963"},
        Refused{"AMinimumOutOfRange", "#TANGFEED [RMIN=10000000]", "1:1 900105"},
        Refused{"Online", "#TRC [ONLINE=1]", "1:7 900102"},
        Refused{"ASplitWithoutLength", "#TRC [SPLIT_PATH FEED_SEG1=5]", "1:1 900005"},
        Refused{"ASplitAcrossThePlane", "#TRC [SPLIT AX=Z DIST_SEG1=5 FEED_SEG1=9]\nG41 X1",
                "2:1 900005"},
        Refused{"ASplitAcrossThePlaneInTheContour",
                "G18 G41 X1\n#TRC [SPLIT AX=Y DIST_SEG1=5 FEED_SEG1=9]", "2:1 900005"}),
    named);

// Lines of cycles and calls are copied as they stand; a terminal would obey what is in them.
TEST(Refusal, ControlCharactersAreRefusedHoweverTheLineIsRead) {
  struct Copied {
    DialectName dialect;
    std::string text;
    const char* place_and_code;
  };
  const std::string escape = "\x1b[2J";
  const std::string null(1, '\0');
  for (const auto& [dialect, text, place] : {
           Copied{DialectName::heidenhain, "1 CYCL DEF 200" + null + escape, "1:15 900007"},
           Copied{DialectName::heidenhain, "1 CALL LBL 1" + null, "1:13 900007"},
           Copied{DialectName::heidenhain, "1 CYCL DEF 200 ~" + escape, "1:17 900007"},
           Copied{DialectName::sinumerik, "CYCLE81(1," + null + "2)", "1:11 900007"},
           Copied{DialectName::sinumerik, "MSG(\"a" + escape + "\")", "1:7 900007"},
           Copied{DialectName::fanuc, "POPEN\nDPRNT[A" + escape + "]", "2:8 900007"},
       }) {
    const ProgramSetup setup{.dialect = dialect};
    const Reading reading = read(text, setup);
    ASSERT_FALSE(reading.diagnostics.empty()) << text;
    EXPECT_EQ(place_and_code(reading.diagnostics.back()), place) << text;
    EXPECT_TRUE(reading.stopped);
  }
}

TEST(Refusal, ControlCharactersMayStandInComments) {
  const std::string odd = "\x01\x7f";
  struct Commented {
    DialectName dialect;
    std::string text;
  };
  for (const auto& [dialect, text] : {
           Commented{DialectName::heidenhain, "1 CYCL DEF 200 ;" + odd + "\n2 ;" + odd},
           Commented{DialectName::sinumerik, "CYCLE81(1,2) ;" + odd + "\n;" + odd},
           Commented{DialectName::fanuc, "(" + odd + ")\nM8 (" + odd + ")"},
           Commented{DialectName::linuxcnc, "M8 ;" + odd},
       })
    EXPECT_FALSE(read(text, ProgramSetup{.dialect = dialect}).stopped) << text;
}

// These programs go on with a warning.
TEST(Warning, AStretchFactorOutOfRangeBecomesOne) {
  for (const char* value : {"0", "10", "0.5", "-3"}) {
    const Reading reading = read(
        "#TRC [STRETCH_FACTOR=3]\n#TRC [REVERSE=1 STRETCH_FACTOR=" + std::string(value) + "]\nX1");
    EXPECT_EQ(place_and_code(reading.only()), "2:1 22007");
    EXPECT_FALSE(reading.stopped);
    EXPECT_EQ(reading.last_motion().mode->options, (TrcOptions{.reverse = true}));
  }
}

TEST(Warning, G05UnderG238IsIgnored) {
  const Reading reading = read("G238\nG05 G41 X1\nX2\nG40 X3");
  EXPECT_EQ(place_and_code(reading.only()), "2:1 21316");
  for (const MotionBlock& motion : reading.motions()) EXPECT_FALSE(motion.mode->tangential);
}

TEST(Warning, ASelectionWithoutMotionDoesNotTakePlace) {
  const Reading reading = read("G41\nM8\nG40\nG41 X1\nX2\nG40 X3");
  EXPECT_EQ(place_and_code(reading.only()), "3:1 900204");
  EXPECT_EQ(reading.motions().size(), 3U);
}

TEST(Warning, TheProgramEndsWhileTrcIsActive) {
  EXPECT_EQ(place_and_code(read("G41 X1\nX2\nM30\n").only()), "3:0 900205");
  EXPECT_EQ(place_and_code(read("G41 X1\nX2\n").only()), "2:0 900205");
}

TEST(Warning, TheProgramEndsBeforeTheRetract) {
  EXPECT_EQ(place_and_code(read("G41 X1\nX2\nG40\nZ5\nM30").only()), "5:0 900205");
}

TEST(Warning, NoneWhenTheModeNeedsNoRetract) {
  EXPECT_TRUE(read("G239\nG41 X1\nX2\nG40\nM30").diagnostics.empty());
  EXPECT_TRUE(read("G237\nG41 X1\nX2\nG40\nM30").diagnostics.empty());
  EXPECT_TRUE(read("G239\nG41 X1\nX2\nG40\nG41 X3\nX4\nG40\nM30").diagnostics.empty());
}

TEST(TrcSequence, G40WithoutSelectionIsNoFault) {
  EXPECT_TRUE(read("G40 G17 G90\nX1\nG40\nM30").diagnostics.empty());
}

TEST(TrcSequence, FunctionsOfThePresentStateMayBeRepeated) {
  EXPECT_TRUE(read("G17 G139\nG41 X1\nG41 X2\nG17 G139\nX3\nG40 X4").diagnostics.empty());
}

// After a command a motion would pass as text.
TEST(Commands, StandAloneInTheirBlock) {
  for (const std::string command :
       {"#HSC ON X30", "#CONTOUR MODE OFF X30", "#MSG [\"T\"] X30", "#MSG SYN [\"T\"] G40 X30",
        "#SIGNAL [ID1] X30", "#FLUSH X30", "#FLUSH LL A", "#SLOPE[TYPE=STEP] G01 X30",
        "#WAIT FOR V.E.GO == 1 X30", "#VECTOR LIMIT ON [VEL 5] M8", "#FLUSH X=5", "#FLUSH $GOTO N1",
        "#CS OFF X3"})
    EXPECT_EQ(read("G00 X0\n" + command + "\nX5\n").code(), Code::nc_syntax) << command;
  for (const std::string command :
       {"#HSC ON", "#HSC [BSPLINE PATH_DEV 0.01]", "#CONTOUR MODE [DEV, PATH_DEV 0.1]",
        "#MSG SYN [\"X30 %d\", 5]", "#FLUSH WAIT", "#WAIT FOR V.E.GO == 1", "#SIGNAL [ID1]",
        "#PSET X10 Y0", "#CS ON [1,2,3,0,0,P1]", "#SET SLOPE PROFIL [1]",
        "#FILE NAME [MAIN=\"A\"]"})
    EXPECT_FALSE(read("G00 X0\n" + command + "\nG90 X5\n").stopped) << command;
}

}  // namespace
}  // namespace trc::testing
