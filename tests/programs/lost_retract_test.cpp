#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/programs/computing.h"

// After a deselection without motion the tool stands beside the contour, by its radius. Where
// what is copied then leads it away, nothing may be written for an axis that the program does not
// name (D-74).

namespace trc::support {
namespace {

using enum DialectName;

ProgramSessionSetup setup_of(DialectName dialect) { return computing_setup(dialect, 5); }

// The contour ends at X80 Y50, the tool at X80 Y55.
std::string behind_contour(DialectName dialect, const std::string& text) {
  const std::string number = dialect == fanuc ? "." : "";
  const std::string program = dialect == heidenhain
                                  ? "L X-20 Y-20 Z-5 R0 FMAX\nL X+0 RL F500\nL Y+50\nL X+80\n"
                                  : "G90 G17 G0 X-20" + number + " Y-20" + number +
                                        "\nG41 G1 X0 F300\nY50" + number + "\nX80" + number + "\n";
  return program + text;
}

// The output of the text after the contour.
std::string written(DialectName dialect, const std::string& text) {
  const std::string all = flat_of(behind_contour(dialect, text), setup_of(dialect));
  const std::string last = dialect == heidenhain ? "L X+80 Y+55\n" : "Y55";
  const std::size_t at = all.rfind(last);
  if (at == std::string::npos) return "no contour in: " + all;
  return all.substr(all.find('\n', at) + 1);
}

int refused(DialectName dialect, const std::string& text) {
  return refusal_of(behind_contour(dialect, text), setup_of(dialect)).first;
}

TEST(LostRetract, MovesTheAxesThatTheProgramMoves) {
  // The retract itself, where nothing lies between.
  EXPECT_EQ(written(fanuc, "G40\nG0 X5.\nM30\n"), "G00 X5. Y50.\nM30\n");
  for (const std::string away :
       {"G28 Y0", "G53 Y0", "G55", "G92 Y0", "G68 X0 Y0 R90.", "G54.1 P2"}) {
    const std::string text = "G0 Z50.\n" + away + "\nG0 X5.\nZ5.\nM30\n";
    EXPECT_EQ(written(fanuc, "G40\n" + text), text) << away;
  }
  const std::string supa = "G0 Z50\nSUPA G0 Y0\nG0 X5\nM30\n";
  EXPECT_EQ(written(sinumerik, "G40\n" + supa), supa);
  const std::string shift = "G0 Z50\nTRANS X100 Y200\nG0 X5\nM30\n";
  EXPECT_EQ(written(sinumerik, "G40\n" + shift), shift);
  const std::string skipped = "/X200.\nY100.\nM30\n";
  EXPECT_EQ(written(fanuc, "G40\nG0 Z50.\n" + skipped), "G0 Z50.\n" + skipped);
  // G40 beside what is copied.
  EXPECT_EQ(written(fanuc, "G40 G53 G0 X0 Y0\nG0 X5.\nM30\n"), "G40 G53 G0 X0 Y0\nG0 X5.\nM30\n");
  EXPECT_EQ(written(fanuc, "G40 G55 G0 X5.\nY9.\nM30\n"), "G40 G55 G0 X5.\nY9.\nM30\n");
}

TEST(LostRetract, OfKlartextMovesTheAxesThatTheProgramMoves) {
  for (const std::string away :
       {"CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+100\nCYCL DEF 7.2 Y+200\nL X+5 FMAX",
        "CYCL CALL POS X+200 Y+200 Z+0 FMAX\nL Y+100 FMAX", "L Y+0 FMAX M91\nL X+5 FMAX",
        "L X+Q1 FMAX\nL Y+100 FMAX"}) {
    const std::string text = away + "\nM2\n";
    EXPECT_EQ(written(heidenhain, "L Z+50 R0 FMAX\n" + text), "L Z+50 FMAX\n" + text) << away;
  }
}

TEST(LostRetract, EndsWithAMotionOfBothAxes) {
  EXPECT_EQ(written(fanuc, "G40\nG0 Z50.\nG55\nG0 X5. Y5.\nX20.\nM30\n"),
            "G0 Z50.\nG55\nG00 X5. Y5.\nX20.\nM30\n");
  EXPECT_EQ(refused(fanuc, "G40\nG0 Z50.\nG55\nG1 X5. Y5. F300\nX20.\nM30\n"), 0);
}

TEST(LostRetract, LetsNothingBeCutBesideItsPlace) {
  EXPECT_EQ(refused(fanuc, "G40\nG0 Z50.\nG81 X200. Z-5. R2. F100.\nG80\nM30\n"), 900106);
  EXPECT_EQ(refused(fanuc, "G40 G81 X5. Z-5. R2. F100.\nG80\nM30\n"), 900106);
  EXPECT_EQ(refused(fanuc, "G40\nG55\nG1 X5. F300\nM30\n"), 900106);
  EXPECT_EQ(refused(fanuc, "G40\nG55\nG0 X5.\nG1 Z-5. F300\nM30\n"), 900106);
  EXPECT_EQ(refused(heidenhain, "L X+100 R0 FMAX M99\nM2\n"), 900106);
  EXPECT_EQ(refused(heidenhain, "L Z+50 R0 FMAX\nCYCL CALL\nM2\n"), 900106);
  // The cycle positions both axes.
  EXPECT_EQ(refused(fanuc, "G40\nG0 Z50.\nG81 X200. Y20. Z-5. R2. F100.\nG80\nM30\n"), 0);
  EXPECT_EQ(refused(heidenhain, "L X+100 Y+0 R0 FMAX M99\nM2\n"), 0);
  EXPECT_EQ(refused(heidenhain, "L Z+50 R0 FMAX\nCYCL CALL PAT F5000 M3\nM2\n"), 0);
}

// Codes of what is told of a program, one after the other.
std::string told(DialectName dialect, const std::string& text) {
  const ProgramRun ran = to_text(behind_contour(dialect, text), setup_of(dialect));
  std::string codes;
  for (const Diagnostic& found : ran.diagnostics)
    codes += std::to_string(static_cast<int>(found.code)) + ' ';
  return codes;
}

TEST(LostRetract, WarnsOfAnEndBesideTheContourAlone) {
  EXPECT_EQ(told(fanuc, "G40\nG0 Z50.\nG90 G53 X0 Y0\nM30\n"), "");
  EXPECT_EQ(told(sinumerik, "G40\nSUPA G0 X0 Y0 D0\nM30\n"), "");
  EXPECT_EQ(told(heidenhain, "L Z+50 R0 FMAX\nL X+0 Y+0 FMAX M91\nM2\n"), "");
  EXPECT_EQ(told(fanuc, "G40\nG0 Z50.\nG28 Y0\nM30\n"), "900205 ");
}

TEST(LostRetract, LeavesOrdinaryEndsAlone) {
  EXPECT_EQ(refused(fanuc, "G40 G80\nG0 Z50.\nG91 G28 Z0\nG28 Y0\nM30\n"), 0);
  EXPECT_EQ(refused(fanuc, "G40\nG0 Z50.\nG91 G28 X0 Y0 Z0\nM30\n"), 0);
  EXPECT_EQ(refused(fanuc, "G40\nG0 Z50.\nG90 G53 X0 Y0\nM30\n"), 0);
  EXPECT_EQ(refused(sinumerik, "G40\nSUPA G0 X0 Y0 D0\nM30\n"), 0);
}

}  // namespace
}  // namespace trc::support
