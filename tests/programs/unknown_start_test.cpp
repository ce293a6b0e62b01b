#include <gtest/gtest.h>

#include <string>

#include "tests/programs/computing.h"

// A direct approach ends where it does from wherever the tool comes (D-170).

namespace trc::support {
namespace {

using enum DialectName;

int code_of(DialectName dialect, const std::string& text) {
  return refusal_of(text, setup_with_tool(dialect)).first;
}

std::string lines(const std::string& approach) {
  return approach + "G1 Y40. F500.\nX30.\nY0.\nG40 X60.\nM30\n";
}

TEST(UnknownStart, LeavesADirectApproachAsItIs) {
  const std::string head = "G17 G90 G40\nT1\n";
  for (const auto& [dialect, change] : {std::pair{fanuc, "G54\n"},
                                        {fanuc, "G92 X0 Y0\n"},
                                        {fanuc, "G28 G91 X0 Y0\nG90\n"},
                                        {linuxcnc, "G55\n"},
                                        {sinumerik, "TRANS X10 Y20\n"},
                                        {sinumerik, "ATRANS X10 Y20\n"},
                                        {sinumerik, "ROT RPL=30\n"}}) {
    const std::string contour = lines("G41 D1 G0 X0. Y-10.\n");
    EXPECT_EQ(flat_of(head + change + "G0 X-20. Y-10.\n" + contour, setup_with_tool(dialect)),
              head + change + "G0 X-20. Y-10.\n" +
                  flat_of(head + "G0 X-20. Y-10.\n" + contour, setup_with_tool(dialect))
                      .substr(head.size() + std::string("G0 X-20. Y-10.\n").size()))
        << change;
    EXPECT_EQ(flat_of(head + change + contour, setup_with_tool(dialect)),
              head + change + flat_of(head + contour, setup_with_tool(dialect)).substr(head.size()))
        << change;
  }
}

TEST(UnknownStart, LeavesTheApproachOfKlartextAsItIs) {
  const std::string head = "TOOL CALL 1 Z S1000\nL Z+50 R0 FMAX\n";
  const std::string shift = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+5\n";
  const std::string contour =
      "L X+0 Y-10 RL FMAX\nL Z-5 F200\nL Y+40\nL X+30\nL Y+0\nL X+60 R0\nM30\n";
  EXPECT_EQ(
      flat_of(head + shift + contour, setup_with_tool(heidenhain)),
      head + shift + flat_of(head + contour, setup_with_tool(heidenhain)).substr(head.size()));
}

TEST(UnknownStart, IsRefusedWhereTheApproachDependsOnIt) {
  EXPECT_EQ(code_of(fanuc, "G0 X5. Y5.\nG54\n" + lines("G41 D1 G0 X0.\n")), 900106);
  EXPECT_EQ(code_of(fanuc, "G0 X5. Y5.\nG54\n" + lines("G91 G41 D1 G0 X5. Y-10.\nG90\n")), 900106);
  // It would be no motion if the offset were the same.
  EXPECT_EQ(code_of(fanuc, "G0 X0. Y-10.\nG54\n" + lines("G41 D1 G0 X0. Y-10.\n")), 900106);
  EXPECT_EQ(code_of(sinumerik, "T1\nG90\nTRANS X5\n" + lines("KONT G41 G0 X0. Y-10.\n")), 900106);
  EXPECT_EQ(code_of(isg, "G90\nG54\n" + lines("G41 G0 X0. Y-10.\n")), 900106);
  EXPECT_EQ(code_of(isg, "G90\nG54\n" + lines("G138 G05 G41 G0 X0. Y-10.\n")), 900106);
  EXPECT_EQ(code_of(isg, "G90\nG54\n" + lines("G138 G41 G0 X0. Y-10.\n")), 0);
}

// The third axis alone comes no nearer to the contour.
TEST(UnknownStart, WaitsForTheMotionInThePlane) {
  EXPECT_EQ(code_of(fanuc, "G0 X5. Y5.\nG54\n" + lines("G41 D1\nG0 Z-5.\nG0 X0. Y-10.\n")), 0);
}

}  // namespace
}  // namespace trc::support
