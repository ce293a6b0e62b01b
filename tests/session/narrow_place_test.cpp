#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/program_run.h"

namespace trc::support {
namespace {

// The last diagnostic, or an empty one.
Diagnostic last_told(std::string_view program, const ProgramSessionSetup& setup = {},
                     std::size_t piece = 0) {
  const ProgramRun run = to_text(program, setup, piece);
  return run.diagnostics.empty() ? Diagnostic{} : run.diagnostics.back();
}

// A slot of this width, mm, whose floor is `rise` higher at its end, far after the start.
std::string slot(double width, double rise, const std::string& head = "G138") {
  std::string text = "G0 X-20 Y0 F500\nV.G.WZ_AKT.R=6\n" + head + "\nG42 G1 X0 Y0\n";
  for (int x = 1; x <= 40; ++x) text += "X" + std::to_string(x) + "\n";
  text += "Y30\nX" + std::to_string(40 + width) + " Y" + std::to_string(30 + rise) + "\nY0\n";
  return text + "X90\nG40 X120\nM30\n";
}

std::string begin_of(const Diagnostic& found, Language language = Language::english) {
  const std::string text = message_of(found, language);
  return text.substr(0, text.find(": "));
}

TEST(NarrowPlace, OfASlotIsTheDistanceOfItsWalls) {  // D-145
  for (const double rise : {0.0, 3.0, -3.0})
    for (const std::size_t piece : {1U, 0U}) {
      const Diagnostic found = last_told(slot(8, rise), {}, piece);
      EXPECT_EQ(found.code, Code::line_reversed);
      EXPECT_EQ(begin_of(found), "tool ⌀12.000 mm does not fit, the slot is 8.000 mm wide here");
      EXPECT_EQ(begin_of(found, Language::german),
                "Werkzeug ⌀12.000 mm passt nicht, die Nut ist hier 8.000 mm breit");
    }
}

TEST(NarrowPlace, OfASlotIsSaidInTheUnitOfTheProgram) {  // D-46
  ProgramSessionSetup setup;
  setup.session.program.inch = true;
  std::string program = slot(8, 0);
  EXPECT_EQ(begin_of(last_told(program, setup)),
            "tool ⌀12.0000 in does not fit, the slot is 8.0000 in wide here");
}

// Walls that do not face each other are no slot: the tool passes the corner of two of them.
TEST(NarrowPlace, IsNoSlotBetweenTheWallsOfACorner) {
  const Diagnostic found = last_told(
      "V.G.WZ_AKT.R=7.5\nG141\nG0 X60 Y-20\nG138 G42 G1 X60 Y0 F800\nX5\nY14.99997\nX10\nY25\n"
      "X-10\nG40 X-10 Y60\nM30\n");
  EXPECT_EQ(found.code, Code::bottleneck);
  EXPECT_EQ(begin_of(found).find("slot"), std::string::npos) << message_of(found);
  const Diagnostic neck = last_told(
      "G0 X-60 Y-80 F1000\nV.G.WZ_AKT.R=10\nG141\nG138 G41 G1 X-60 Y-40\nX0\nY0\nX50\nY-10\nX90\n"
      "Y25\nX50\nY15\nX5\nY75\nX-60\nG40 Y95\nM30\n");
  EXPECT_NE(begin_of(neck).find("the slot is"), std::string::npos) << message_of(neck);
}

// A chamfer between walls that open: what tool leaves it a length.
TEST(NarrowPlace, BetweenOtherWallsIsTheLargestToolThere) {  // D-145
  const std::string chamfer =
      "G0 X-30 Y0 F1000\nV.G.WZ_AKT.R=10\nG41 G1 X0\nX50\nX55 Y5\nX55 Y50\nG40 Y80\nM30\n";
  const Diagnostic found = last_told(chamfer);
  EXPECT_EQ(found.code, Code::line_reversed);
  // 5·√2 / (2·tan 22.5°) = 8.5355, of which whole micrometres.
  EXPECT_EQ(begin_of(found), "tool ⌀20.000 mm does not fit, there is room for ⌀17.070 mm here");
}

TEST(NarrowPlace, IsToldOfABottleneckToo) {
  const std::string two_walls =
      "G0 X-20 Y0 F500\nV.G.WZ_AKT.R=6\nG42 G1 X0 Y0\nX40\nY20\nX30\nY60\nX58\nY20\nX50\nY0\nX90\n"
      "G40 X120\nM30\n";
  ProgramSessionSetup setup;
  setup.session.compensator.implicit_contour_masking = true;
  const Diagnostic found = last_told(two_walls, setup);
  EXPECT_EQ(found.code, Code::bottleneck) << message_of(found);
  EXPECT_EQ(begin_of(found), "tool ⌀12.000 mm does not fit, the slot is 10.000 mm wide here");
}

TEST(NarrowPlace, OfAnInsideCornerHelpsNoSmallerTool) {
  const std::string square =
      "G0 X20 Y20 F1000\nV.G.WZ_AKT.R=5\nG138\nG41 G1 X0 Y0\nX50\nY50\nX0\nY0\nG40 X20 Y20\nM30\n";
  ProgramSessionSetup setup;
  setup.session.verify = Verify::enforce;
  const Diagnostic found = last_told(square, setup);
  ASSERT_TRUE(found.entry_help);
  EXPECT_EQ(help_of(found),
            "Do not machine it so. Begin the contour in another place, or select with G238: in an "
            "inside corner no tool has room, however small.");
  EXPECT_EQ(help_of(found, Language::german).find("kleineren"), std::string::npos);
}

}  // namespace
}  // namespace trc::support
