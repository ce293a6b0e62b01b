#include <gtest/gtest.h>

#include <string>

#include "core/nc/convert/conversion.h"
#include "tests/programs/computing.h"

// Lines in which nothing changes come out byte for byte. Lines that are written anew name each axis
// as the program does.

namespace trc::support {
namespace {

using enum DialectName;

std::string text_of(const std::string& text, const ProgramSessionSetup& setup) {
  const ProgramRun ran = to_text(text, setup);
  return ran.stopped ? ran.report() : ran.text;
}

// Compensation changes only the lines of G41 and G40.
TEST(KeptLines, OfAContourWithoutARadius) {  // D-119
  const std::string before = "G21 G90 G17\nG0 X-20. Y-20. Z5\nG1 Z-2. F100\n";
  const std::string contour = " y30.0\nN7 X20 (flat)\nG2 X30. Y20 I0 J-10.\nG1 Y0 F200 M8\nX0\n";
  EXPECT_EQ(text_of(before + "G41 D0 G1 X0. Y0. F300\n" + contour + "G40 X-20. Y-20.\nM30\n",
                    computing_setup(fanuc, 0)),
            before + "G01 X0. Y0. F300\n" + contour + "G01 X-20. Y-20.\nM30\n");
}

TEST(KeptLines, OfAContourOfKlartextWithoutARadius) {
  ProgramSessionSetup setup = computing_setup(heidenhain, 0);
  setup.session.program.tool_radius_given = true;
  const std::string before = "0 BEGIN PGM A MM\n1 L  X-20 Y-20  R0 FMAX\n";
  const std::string contour = "3 L   Y+50.000   ; HIGH\n4 L X+40 Y50 F200 M8\n";
  const std::string behind = "7 L Y+0\n8  L X+0\n";
  EXPECT_EQ(
      text_of(before + "2 L X+0 Y+0 RL F100\n" + contour + "5 CC X+50 Y+50\n6 C X+60 Y+50 DR-\n" +
                  behind + "9 L X-20 R0\n10 END PGM A MM\n",
              setup),
      before + "2 L X+0 Y+0 F100\n" + contour + "5 CC X+50 Y+50\n6 C X+60 Y+50 DR-\n" + behind +
          "9 L X-20 Y+0\n10 END PGM A MM\n");
}

// Corners and turns become lines of their own: the lines beside them are written anew.
TEST(KeptLines, AreNoneBesideCornersOfAContourWithoutARadius) {
  const auto of = [](DialectName dialect, const std::string& contour) {
    ProgramSessionSetup setup = computing_setup(dialect, 0);
    setup.session.program.tool_radius_given = true;
    const bool klartext = dialect == heidenhain;
    const std::string begin = klartext ? "L X-20 Y+0 R0 FMAX\nL X+0 Y+0 RL F100\n"
                                       : "G90 G17 G21\nG0 X-20. Y0.\nG41 G1 X0. F100\n";
    const std::string text = begin + contour + (klartext ? "L X-20 R0\n" : "G40 X-20.\nM30\n");
    const bool iso = dialect != sinumerik;
    return text_of(iso ? text : "G71" + text.substr(text.find('\n')), setup);
  };
  const auto has = [](const std::string& text, const std::string& line) {
    return text.find("\n" + line) != std::string::npos;
  };
  const std::string rounded = of(fanuc, "Y30. ,R2.\nG2 X40. Y30. I20. J10.\nG1 Y0.\n");
  EXPECT_TRUE(has(rounded, "G01 X0. Y")) << rounded;
  EXPECT_FALSE(has(rounded, "G2 X40. Y30.")) << rounded;
  EXPECT_TRUE(has(rounded, "G1 Y0.")) << rounded;
  const std::string steps = of(fanuc, "Y30. ,C5.\nG91 X20.\nG90 Y0.\n");
  EXPECT_TRUE(has(steps, "G91 G01 X15.")) << steps;
  const std::string modal = of(sinumerik, "RNDM=5\nY30\nX20\nRNDM=0\nY0\n");
  EXPECT_TRUE(has(modal, "G01 X0 Y25\n")) << modal;
  const std::string polar = of(sinumerik, "G111 X0 Y0\nRP=20 AP=90\nAP=IC(-30)\nY0\n");
  EXPECT_TRUE(has(polar, "G01 X10 Y17.32050808\n")) << polar;
  const std::string klartext = of(heidenhain, "L Y+30\nRND R5\nL X+20\nCHF 3\nL  Y+0\n");
  EXPECT_TRUE(has(klartext, "L X+0 Y+25\n")) << klartext;
  EXPECT_TRUE(has(klartext, "L X+17 Y+30\n")) << klartext;
  EXPECT_TRUE(has(klartext, "L  Y+0\n")) << klartext;
  const std::string turns = of(linuxcnc, "G3 I5 J0 P2\nG1 Y30\n");
  EXPECT_FALSE(has(turns, "G3 I5 J0 P2")) << turns;
}

TEST(KeptLines, WithAxesThatHaveNamesOfTheirOwn) {  // D-119
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

TEST(KeptLines, AxesThatHaveNamesOfTheirOwnAreInNoOtherDialect) {
  ProgramSetup setup = computing_setup(isg, 5).session.program;
  setup.tracking_axes = {"X1"};
  const ConvertedProgram converted =
      convert_program("G90 G17\nG00 X-20 Y0\nG01 X10 X1=7 F100\nM30\n", setup, fanuc);
  ASSERT_EQ(converted.faults.size(), 1U);
  EXPECT_EQ(converted.faults.front().word, "X1=7");
}

}  // namespace
}  // namespace trc::support
