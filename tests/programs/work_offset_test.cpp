#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/programs/computing.h"

// A work offset that is in force already changes nothing where it is selected once more: posts
// write it before every section.

namespace trc::support {
namespace {

using enum DialectName;

int code_of(DialectName dialect, const std::string& text) {
  return refusal_of(text, computing_setup(dialect, 2)).first;
}

std::string behind(const std::string& first, const std::string& second) {
  return "G90\n" + first + "\nG0 X0 Y0\n" + second + "\nG91\nG0 X10.\nG90\nM30\n";
}

TEST(WorkOffset, SelectedOnceMoreLeavesThePositionKnown) {  // D-111
  using Selections = std::vector<std::pair<DialectName, std::vector<std::string>>>;
  for (const auto& [dialect, offsets] : Selections{
           {isg, {"G54", "G58"}},
           {fanuc, {"G54", "G59", "G54.1 P3", "G154 P12", "G110"}},
           {linuxcnc, {"G54", "G59.2"}},
           {sinumerik, {"G54", "G505", "G500"}},
       })
    for (const std::string& offset : offsets) {
      EXPECT_EQ(code_of(dialect, behind(offset, offset)), 0) << offset;
      EXPECT_EQ(code_of(dialect, behind(offset, "G55")), 900106) << offset;
      EXPECT_EQ(code_of(dialect, behind("G55", offset)), 900106) << offset;
      EXPECT_EQ(code_of(dialect, behind("", offset)), 900106) << offset;
    }
  EXPECT_EQ(code_of(fanuc, behind("G54.1 P3", "G54.1 P4")), 900106);
  EXPECT_EQ(code_of(isg, behind("G159=2", "G159=3")), 900106);
}

// One block that is not shifted ends no selection.
TEST(WorkOffset, StaysAfterBlocksWithoutIt) {
  for (const std::string block : {"SUPA G0 Z100", "G0 SUPA Z100 D0", "G53 G0 Z100", "G153 G0 Z100"})
    EXPECT_EQ(code_of(sinumerik, behind("G54", block + "\nG54")), 0) << block;
  EXPECT_EQ(code_of(sinumerik, behind("G54", "SUPA G0 X5\nG54")), 900106);
}

TEST(WorkOffset, IsNotTakenForTheSameAfterWhatMayHaveMovedIt) {  // D-111
  for (const std::string moved :
       {"G10 L2 P1 X5.", "G10 L2 P1 X5.\nG0 X0 Y0", "#5221=5.\nG0 X0 Y0", "G52 X5.\nG0 X0 Y0",
        "G68 X0 Y0 R90.\nG69\nG0 X0 Y0", "G92 X0 Y0", "G65 P9810 X1.\nG90 G0 X0 Y0",
        "G37 Z5.\nG0 X0 Y0", "/G55\nG0 X0 Y0", "/G54\nG0 X0 Y0"})
    EXPECT_EQ(code_of(fanuc, behind("G54", moved + "\nG54")), 900106) << moved;
  for (const std::string moved : {"$P_UIFR[1]=CTRANS(X,10)\nG0 X0 Y0", "TRANS X10\nG0 X0 Y0",
                                  "CYCLE977(1,2,3)\nG0 X0 Y0", "SETZERO(1)\nG90 G0 X0 Y0"})
    EXPECT_EQ(code_of(sinumerik, behind("G54", moved + "\nG54")), 900106) << moved;
  for (const std::string moved : {"G92 X0 Y0\nG90 G0 X0 Y0", "L ZERO\nG90 G0 X0 Y0"})
    EXPECT_EQ(code_of(isg, behind("G54", moved + "\nG54")), 900106) << moved;
}

TEST(WorkOffset, StandsInTheContourWhereItIsInForce) {
  const auto contour = [](const std::string& offset) {
    return "G90 G17 G54\nG0 X-20. Y0.\n" + offset + " G41 D1 G1 X0. F500.\n" + offset + "\nY40.\n" +
           offset + "\nX30.\nG40 X60.\nM30\n";
  };
  for (const DialectName dialect : {fanuc, linuxcnc, sinumerik}) {
    ProgramSessionSetup setup = computing_setup(dialect, 2);
    setup.session.program.tools = {{1, ToolRow(2)}};
    const std::string head = dialect == sinumerik ? "T1\n" : "";
    const ProgramRun ran = to_blocks(head + contour("G54"), setup);
    EXPECT_FALSE(ran.stopped) << ran.report();
    EXPECT_NE(refusal_of(head + contour("G55"), setup).first, 0);
  }
  const std::string isg_contour = "G90 G54\nG0 X-20 Y0\nG41 G1 X0 F500\nG54\nY40\nG40 X-20\nM30\n";
  EXPECT_EQ(code_of(isg, isg_contour), 0);
}

// G92 says where the tool stands and moves nothing: neither does a line after it that names no Z.
TEST(WorkOffset, SetWhereTheToolStandsMovesNoAxisThatNobodyNames) {
  for (const std::string behind_it : {"", "G92.1\n", "G54\n", "G53 G0 Z0\n"}) {
    const std::string text = "G21 G90 G17 G40\nG0 X0. Y0. Z20.\nG92 X5. Y5. Z5.\n" + behind_it +
                             "G0 X-20. Y0.\nG1 Y-2. F100.\nX4.\nG0 Z3.\nX9.\nM30\n";
    for (const DialectName dialect : {fanuc, linuxcnc})
      EXPECT_EQ(flat_of(text, computing_setup(dialect, 2)), text);
  }
}

}  // namespace
}  // namespace trc::support
