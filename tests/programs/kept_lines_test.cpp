#include <gtest/gtest.h>

#include <string>

#include "tests/programs/computing.h"

// What nothing changes in comes out byte for byte, and what is written anew names each axis as the
// program does.

namespace trc::support {
namespace {

using enum DialectName;

std::string text_of(const std::string& text, const ProgramSessionSetup& setup) {
  const Ran ran = run_computing(text, setup, Output::nc_text);
  return ran.stopped ? ran.report() : ran.text;
}

// Only the lines of G41 and G40 have something to lose.
TEST(KeptLines, OfAContourWithoutARadius) {
  const std::string before = "G21 G90 G17\nG0 X-20. Y-20. Z5\nG1 Z-2. F100\n";
  const std::string contour = " y30.0\nN7 X20 (flat)\nG2 X30. Y20 I0 J-10.\nG1 Y0 F200 M8\nX0\n";
  EXPECT_EQ(text_of(before + "G41 D0 G1 X0. Y0. F300\n" + contour + "G40 X-20. Y-20.\nM30\n",
                    computing_setup(fanuc, 0)),
            before + "G01 X0. Y0. F300\n" + contour + "G01 X-20. Y-20.\nM30\n");
  // A rounding that is followed has a line of its own.
  EXPECT_NE(text_of(before + "G41 D0 G1 X0. Y0. F300\nY30. ,R5.\nX20.\nG40 X40.\nM30\n",
                    computing_setup(fanuc, 0))
                .find("Y25."),
            std::string::npos);
}

TEST(KeptLines, WithAxesThatHaveNamesOfTheirOwn) {
  ProgramSessionSetup setup = computing_setup(isg, 5);
  setup.session.program.tracking_axes = {"X1", "C2", "B"};
  const std::string head = "G90 G17 G162\nG00 X-20 Y0 X1=5 C2=3 B2\nG01 X1=7 F100\n";
  EXPECT_EQ(text_of(head + "M30\n", setup), head + "M30\n");
  EXPECT_EQ(text_of(head + "G41 G01 X0 Y0 X1=8.5\nY40 C2=4\nG40 X-20 X1=9 B3\nM30\n", setup),
            head + "G01 X-5 Y0 X1=8.5\nG01 X-5 Y40 C2=4\nG01 X-20 Y40 X1=9 B3\nM30\n");
  setup.session.program.dialect = sinumerik;
  const std::string named = "G90 G17 G71\nG0 X-20 Y0 X1=5\nG1 X1=7 F100\n";
  EXPECT_EQ(text_of(named + "M30\n", setup), named + "M30\n");
  EXPECT_EQ(text_of(named + "G41 G1 X0 Y0 X1=8.5\nY40\nG40 X-20 X1=9\nM30\n", setup),
            named + "G01 X-5 Y0 X1=8.5\nG01 X-5 Y40\nG01 X-20 Y40 X1=9\nM30\n");
}

}  // namespace
}  // namespace trc::support
