#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/programs/computing.h"

// Where the tool stands before a program is only assumed unless the setup says so (D-156).

namespace trc::support {
namespace {

using enum DialectName;

std::pair<int, std::uint32_t> told(DialectName dialect, const std::string& text) {
  ProgramSessionSetup setup = computing_setup(dialect, 5);
  setup.session.program.start_is_assumed = true;
  return refusal_of(text, setup);
}

const std::string rest = "X60.\nY0.\nG40 X80.\nM30\n";

TEST(AssumedStart, DecidesNoWallOfAContour) {
  for (const DialectName dialect : {fanuc, linuxcnc, sinumerik}) {
    EXPECT_EQ(told(dialect, "G41 G1 Y40. F500.\n" + rest), std::pair(900106, 1U));
    EXPECT_EQ(told(dialect, "G0 Y-20.\nG41 G1 Y40. F500.\n" + rest), std::pair(900106, 2U));
    EXPECT_EQ(told(dialect, "G0 X0.\nG41 G1 Y40. F500.\n" + rest), std::pair(0, 0U));
    EXPECT_EQ(told(dialect, "G41 G1 X-10. Y40. F500.\n" + rest), std::pair(0, 0U));
  }
  EXPECT_EQ(told(isg, "G41 G1 Y40. F500.\n" + rest), std::pair(0, 0U));
  const std::string path = "L X+60\nL Y+0\nL X+80 R0\n";
  EXPECT_EQ(told(heidenhain, "L Y+40 RL F500\n" + path), std::pair(900106, 1U));
  EXPECT_EQ(told(heidenhain, "L X+0 R0 F500\nL Y+40 RL\n" + path), std::pair(0, 0U));
}

TEST(AssumedStart, DecidesNoArcThatLeadsToAContour) {
  const std::string contour = "G41 G2 X20. Y20. I20. J0. F500.\nG1 X40.\nG40 Y60.\nM30\n";
  EXPECT_EQ(told(linuxcnc, contour), std::pair(900106, 1U));
  EXPECT_EQ(told(linuxcnc, "G0 X0. Y0.\n" + contour), std::pair(0, 0U));
}

TEST(AssumedStart, IsKnownWhereThePositionIsPreset) {
  EXPECT_EQ(told(fanuc, "G92 X0 Y0\nG41 G1 Y40. F500.\n" + rest), std::pair(0, 0U));
}

TEST(AssumedStart, IsNotAskedForByIncrements) {
  EXPECT_EQ(told(fanuc, "G91 G41 G1 Y40. F500.\nX60.\nY-40.\nG40 X20.\nM30\n"), std::pair(0, 0U));
}

}  // namespace
}  // namespace trc::support
