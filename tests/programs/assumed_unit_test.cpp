#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/programs/computing.h"

// Lengths before the first unit word count in a unit that only the setup may say (D-167).

namespace trc::support {
namespace {

using enum DialectName;

ProgramSessionSetup assumed(DialectName dialect) {
  ProgramSessionSetup setup = computing_setup(dialect, 0);
  setup.session.program.unit_is_assumed = true;
  return setup;
}

std::pair<int, unsigned> told(DialectName dialect, const std::string& text) {
  return refusal_of(text, assumed(dialect));
}

const std::string wall = "G90 G0 X-2. Y0\nG41 D1 G1 X0 F10.\nY2.\nG40 X-2.\nM30\n";
const std::string wall_of_tool = "T1 D1\nG90 G0 X-2 Y0\nG41 G1 X0 F10\nY2\nG40 X-2\nM30\n";

TEST(AssumedUnit, LetsNoRadiusBeforeAnotherUnitHold) {
  const std::string wear = "G20\nG10 L12 P1 R.25\nG21\nG10 L13 P1 R.1\nG20\n" + wall;
  for (const std::string radius : {"G10 L12 P1 R.25\n", "#13001=.25\n", "G10 L13 P1 R.01\n"}) {
    EXPECT_EQ(told(fanuc, radius + "G20\n" + wall), std::pair(900003, 2U)) << radius;
    EXPECT_EQ(told(fanuc, "G20\n" + radius + "G10 L12 P1 R.25\n" + wall).first, 0) << radius;
    EXPECT_EQ(told(fanuc, radius + "G21 G10 L12 P1 R5.\n" + wall).first, 0) << radius;
  }
  EXPECT_EQ(told(fanuc, wear).first, 0);
  EXPECT_EQ(told(fanuc, "G20 G10 L12 P1 R.25\n" + wall).first, 0);
  EXPECT_EQ(told(linuxcnc, "G10 L1 P1 R.25\nG20\n" + wall), std::pair(900003, 2U));
  EXPECT_EQ(told(isg, "V.G.WZ_AKT.R = 5\nG70\nM30\n").first, 0);  // it begins with G71
  EXPECT_EQ(told(isg, "V.G.WZ_AKT.R = 5\nG71\nM30\n").first, 0);
}

TEST(AssumedUnit, IsNoneWhereTheSetupSaysIt) {
  const ProgramSessionSetup said = computing_setup(fanuc, 0);
  EXPECT_EQ(refusal_of("G10 L12 P1 R.25\nG20\n" + wall, said).first, 0);
}

TEST(AssumedUnit, OfSinumerikIsThatOfTheMachineToo) {
  const std::string radius = "$TC_DP6[1,1]=0.25\n";
  for (const std::string inch : {"G70\n", "G700\n"})
    EXPECT_EQ(told(sinumerik, radius + inch + wall_of_tool), std::pair(900003, 2U)) << inch;
  EXPECT_EQ(told(sinumerik, "G70\n" + radius + wall_of_tool), std::pair(900003, 2U));
  EXPECT_EQ(told(sinumerik, "G700\n" + radius + wall_of_tool).first, 0);
  EXPECT_EQ(told(sinumerik, "G71\n$TC_DP6[1,1]=1\n" + wall_of_tool).first, 0);
  EXPECT_EQ(told(sinumerik, "$TC_DP6[1,1]=1\nG71\n" + wall_of_tool).first, 0);
}

TEST(AssumedUnit, LeavesNoPlaceAndNoContourAfterIt) {
  const std::string contour = "G41 D1 G1 Y1. F10.\nX5.\nG40 Y9.\nM30\n";
  const std::string radius = "G10 L12 P1 R.25\n";
  EXPECT_EQ(told(fanuc, "G0 X3. Y0\nG20\n" + radius + contour), std::pair(900106, 4U));
  EXPECT_EQ(told(fanuc, "G0 X0 Y0\nG20\n" + radius + contour).first, 0);
  EXPECT_EQ(told(fanuc, "G0 X3. Y0\nG21\n" + radius + contour).first, 0);
}

TEST(AssumedUnit, IsToldWithWhatHelps) {
  const ProgramRun ran = to_text("G10 L12 P1 R.25\nG20\n" + wall, assumed(fanuc));
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].detail, "G20, after a tool radius in line 1, read in mm");
  EXPECT_NE(help_of(ran.diagnostics[0]).find("--unit inch"), std::string::npos);
}

}  // namespace
}  // namespace trc::support
