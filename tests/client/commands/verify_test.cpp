#include <gtest/gtest.h>

#include <string>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

// A rounding is a motion of its own in its line.
TEST(Verify, TellsTheMotionsOfALineApart) {
  const Ended ended = trc({"verify", "-", "--dialect", "sinumerik", "--radius", "2"},
                          "N10 G17 G71 G90 T1 D1\nN20 G0 X-20 Y-20\nN30 G41 G1 X0 Y0 F300\n"
                          "N40 Y50\nN50 X40 RND=6\nN60 Y0\nN70 X-10\nN80 G40 X-20 Y-20\nN90 M30\n");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("smallest clearance 2.0000 mm of 2.0000 mm"), std::string::npos)
      << ended.out;
}

TEST(Verify, FindsTheToolRadiusOnAGoodPath) {
  const Ended ended = trc({"verify", "-"}, demo);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("smallest clearance 10.0000 mm of 10.0000 mm"), std::string::npos)
      << ended.out;
}

TEST(Verify, CountsInTheUnitOfTheProgram) {
  const Ended ended = trc({"verify", "-", "--dialect", "linuxcnc", "--radius", "6.35"},
                          "G20 G17 G90 G40\nG0 X-1 Y-1\nG41 G1 X0 Y0 F10\nY2\nX3\nY0\nX0\n"
                          "G40 X-1 Y-1\nM2\n");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("smallest clearance 0.25000 in of 0.25000 in at X-0.25000 Y0.00000"),
            std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("the path touches 100.0 % of 10.00000 in of wall\n"), std::string::npos)
      << ended.out;
}

TEST(Verify, FindsAGougeThatWasIgnored) {
  const Ended ended = trc({"verify", "-", "--set", "ignore_cont_damage=1"}, violating);
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_NE(ended.err.find("gouge"), std::string::npos) << ended.err;
  // N40 is trimmed to X 45.8579, N60 stands at X 55.
  EXPECT_NE(ended.err.find("smallest clearance 9.1421 mm of 10.0000 mm"), std::string::npos)
      << ended.err;
}

TEST(Verify, FindsARetractThroughTheContour) {
  const Ended ended = trc({"verify", "-", "--radius", "5"},
                          "G0 X-40 Y30 F300\nG1 G41 X0 Y30\nY60\nX100\nY0\nX0\nY30\n"
                          "G40 X120 Y42\nM30\n");
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_EQ(ended.err,
            "<stdin>:8: the approach or the retract leads through the contour at line 3\n");
}

// Full turns of one line are so many blocks, on top of each other or one below the other.
TEST(Verify, CountsEachTurnOfALine) {
  for (const std::string depth : {"", " Z-6"}) {
    const Ended ended = trc({"verify", "-", "--dialect", "sinumerik", "--radius", "3"},
                            "G17 G90 G71\nG0 X0 Y0 Z2\nG1 Z0 F200\nG41 G1 X20 Y0\nG3 X20 Y0" +
                                depth + " I-20 J0 TURN=2\nG3 X0 Y20 I-20 J0\nG40 G1 X0 Y0\nM30\n");
    EXPECT_NE(ended.out.find("the path touches 100.0 % of 376.9911 mm of wall\n"),
              std::string::npos)
        << ended.out;
    EXPECT_EQ(ended.out.find("left out"), std::string::npos) << ended.out;
  }
}

// Inside a square of 40 mm: 5 mm at both sides of each corner.
TEST(Verify, SaysWhyWallsAreNotTouched) {
  const Ended pocket = trc({"verify", "-", "--radius", "5"},
                           "N10 G0 X20 Y10 F1000\nN20 G41 G1 X20 Y0\nN30 X40\nN40 Y40\nN50 X0\n"
                           "N60 Y0\nN70 X20\nN80 G40 Y10\nM30\n");
  EXPECT_EQ(pocket.code, 0) << pocket.err;
  EXPECT_NE(pocket.out.find("the path touches 75.0 % of 160.0000 mm of wall\n"
                            "  40.0000 mm lie in inside corners, into which a round tool does not "
                            "reach: 8 stretches, the longest 5.0000 mm of N30 (line 3)\n"),
            std::string::npos)
      << pocket.out;
  EXPECT_EQ(pocket.out.find("left out"), std::string::npos) << pocket.out;

  const std::string slot =
      "#TRC[REMOVE_MASKED_BLOCKS=1]\nN10 G0 X-20 Y-20 F1000\nN20 G26 G41 G141\nN30 G1 X0 Y0\n"
      "N40 Y40\nN50 X26\nN60 Y30\nN70 X34\nN80 Y40\nN90 X60\nN100 Y0\nN110 X0\nN120 G40 X-20 Y-20\n"
      "M30\n";
  const Ended passed = trc({"verify", "-", "--radius", "5"}, slot);
  EXPECT_EQ(passed.code, 0) << passed.err;
  EXPECT_NE(passed.out.find(" mm are left out or passed by, as the tool has no room there: "),
            std::string::npos)
      << passed.out;
  EXPECT_EQ(passed.out.find("inside corners"), std::string::npos) << passed.out;
  const Ended german = trc({"verify", "-", "--radius", "5", "--lang", "de"}, slot);
  EXPECT_NE(german.out.find(" mm sind ausgelassen oder umgangen, weil das Werkzeug dort keinen "
                            "Platz hat: "),
            std::string::npos)
      << german.out;
}

TEST(Verify, FindsNoGougeInGeneratedContours) {
  for (const char* shape :
       {"polygon", "square", "star", "gear", "wave", "spiral", "meander", "random"}) {
    SCOPED_TRACE(shape);
    const Ended generated = trc({"generate", "--shape", shape, "--blocks", "700", "--seed", "5"});
    EXPECT_EQ(generated.code, 0) << generated.err;
    const Ended verified = trc({"verify", "-"}, generated.out);
    EXPECT_EQ(verified.code, 0) << verified.err;
  }
}

// A bottleneck of 15 mm for a tool of 20, which G140 does not see (rule 6).
const std::string neck =
    "N10 G00 X-60 Y-80 F1000\nN20 V.G.WZ_AKT.R = 10\nN30 G41 G01 X-60 Y-40\nN40 X0\nN50 Y0\n"
    "N60 X50\nN70 Y-10\nN80 X90\nN90 Y25\nN100 X0\nN110 Y15\nN120 X-60\nN130 G40 X-90 Y50\n";

TEST(Verify, CompensateTellsOfAPathThatComesTooNear) {
  const Ended told = trc({"compensate", "-"}, neck);
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.err.find("warning 900216"), std::string::npos) << told.err;
  const Ended refused = trc({"compensate", "-", "--set", "verify=enforce"}, neck);
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("error 900216"), std::string::npos) << refused.err;
  const Ended not_measured = trc({"compensate", "-", "--set", "verify=off"}, neck);
  EXPECT_EQ(not_measured.code, 0);
  EXPECT_EQ(not_measured.err, "");
  EXPECT_EQ(not_measured.out, told.out);
}

}  // namespace
}  // namespace trc::testing_support
