#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "tests/nc/dialect/reading.h"

// While the position of the block skip switch is unknown, no contour may depend on a line with
// `/` (D-59).

namespace trc::testing {
namespace {

bool is_undecided(DialectName name, const std::string& program) {
  ProgramSetup setup;
  setup.dialect = name;
  dialect_of(name).begin(setup.mode);
  setup.tools[1] = ToolRow(2);
  setup.tools[2] = ToolRow(3);
  const Reading known = read(program, setup);
  return std::ranges::any_of(known.diagnostics, [](const Diagnostic& found) {
    return found.code == Code::block_skip_undecided;
  });
}

// A contour with one line before it and one within.
std::string contour(const std::string& before, const std::string& within,
                    const std::string& tool = "T1 M6\n") {
  return "G17 G90\n" + tool + "G0 X-20. Y-20. Z1.\n" + before + "G41 G1 X0. Y0. F100.\nY30.\n" +
         within + "X30.\nY10.\nG40 X50.\nM30\n";
}

TEST(SkippedLines, DecideNoMotionOfAContour) {
  for (const DialectName name : {DialectName::fanuc, DialectName::linuxcnc, DialectName::sinumerik})
    for (const std::string line : {"/G0\n", "/G1\n"}) {
      EXPECT_TRUE(is_undecided(name, contour("", line))) << line;
      // G41 says its own.
      EXPECT_FALSE(is_undecided(name, contour(line, ""))) << line;
    }
  const std::string program =
      "G17 G90\nT1 M6\nG0 X-20. Y-20.\n/G1\nG41 X0. Y0. F100.\nY30.\nG40 X50.\nM30\n";
  EXPECT_TRUE(is_undecided(DialectName::fanuc, program));
}

TEST(SkippedLines, PrepareNoTool) {
  for (const DialectName name : {DialectName::fanuc, DialectName::sinumerik}) {
    EXPECT_TRUE(is_undecided(name, contour("", "", "T1\n/T2\nM6\n")));
    EXPECT_FALSE(is_undecided(name, contour("", "", "/T2\nT1\nM6\n")));
    // The next change takes it.
    EXPECT_FALSE(is_undecided(name, contour("", "", "T1 M6\n/T2\nT1\nM6\n")));
  }
}

TEST(SkippedLines, DecideNoFeedAtTheContour) {
  EXPECT_TRUE(is_undecided(DialectName::sinumerik, contour("", "/F300\n")));
  EXPECT_FALSE(is_undecided(DialectName::sinumerik, contour("/F300\n", "")));
  EXPECT_FALSE(is_undecided(DialectName::fanuc, contour("", "/F300\n")));
  for (const std::string line : {"/CFTCP\n", "/CFIN\n", "/CDON\n"}) {
    EXPECT_TRUE(is_undecided(DialectName::sinumerik, contour(line, ""))) << line;
    EXPECT_TRUE(is_undecided(DialectName::sinumerik, contour("", line))) << line;
  }
}

// The `*` of a punched tape is no word, and a line without words takes no feed.
TEST(SkippedLines, DecideNothingOfALineWithoutWords) {
  for (const DialectName name : {DialectName::fanuc, DialectName::linuxcnc}) {
    ProgramSetup setup;
    setup.dialect = name;
    dialect_of(name).begin(setup.mode);
    setup.mode.feed_adaptation = FeedAdaptation::on;
    setup.tools[1] = ToolRow(2);
    for (const std::string line : {"*", "()", "N5", ""}) {
      const Reading known =
          read("G90 G1\nG41 D1 X10. F50.\n/F100.\n" + line + "\nX20.\nG40 X0.\nM30\n", setup);
      EXPECT_TRUE(std::ranges::none_of(known.diagnostics, [](const Diagnostic& found) {
        return found.code == Code::block_skip_undecided && found.source.line != 5;
      })) << line;
    }
  }
}

TEST(SkippedLines, EndNothingThatAContourHangsOn) {
  const auto refused = [](DialectName name, const std::string& program) {
    ProgramSetup setup;
    setup.dialect = name;
    setup.tools[1] = ToolRow(2);
    return read(program, setup).stopped;
  };
  const auto scaled = [](const std::string& end) {
    return contour("G51 X0 Y0 P2.\n" + end + "G0 X-20. Y-20. Z1.\n", "");
  };
  EXPECT_FALSE(refused(DialectName::fanuc, scaled("G50\n")));
  EXPECT_TRUE(refused(DialectName::fanuc, scaled("/G50\n")));
  const auto led = [](const std::string& end) {
    return "TOOL CALL 1 Z S100\nL X-20 Y-20 R0 FMAX M128\n" + end +
           "L X-20 Y-20 Z+1 R0 FMAX\nL X+0 Y+0 RL F100\nL Y+30\nL X+50 R0\nM30\n";
  };
  EXPECT_FALSE(refused(DialectName::heidenhain, led("M129\n")));
  EXPECT_TRUE(refused(DialectName::heidenhain, led("/M129\n")));
}

TEST(SkippedLines, OfKlartextDecideNoContour) {
  const auto part = [](const std::string& before, const std::string& within) {
    return before + "TOOL CALL 1 Z S100\nL X-20 Y-20 R0 FMAX\nL X+0 Y+0 RL F100\nL Y+30\n" +
           within + "L X+50 R0\nM30\n";
  };
  for (const std::string line : {"/M109\n", "/M120 LA5\n"}) {
    EXPECT_TRUE(is_undecided(DialectName::heidenhain, part(line, ""))) << line;
    EXPECT_TRUE(is_undecided(DialectName::heidenhain, part("", line))) << line;
  }
  EXPECT_TRUE(is_undecided(DialectName::heidenhain, part("/TOOL DEF 1 L+0 R+3\n", "")));
  EXPECT_FALSE(is_undecided(DialectName::heidenhain, part("/M8\n", "/M9\n")));
}

}  // namespace
}  // namespace trc::testing
