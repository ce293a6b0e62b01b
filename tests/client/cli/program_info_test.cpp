#include "client/cli/program_info.h"

#include <gtest/gtest.h>

#include <string>

#include "core/nc/dialect/dialect.h"

namespace trc::cli {
namespace {

std::string told_about(const std::string& program) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  dialect_of(DialectName::fanuc).begin(setup.session.program.mode);
  setup.session.program.tools = {{1, ToolRow(5)}};
  return describe_program(program, setup).text;
}

const std::string begins = "G21 G90 G17 G40\nG0 X-20. Y-20. Z5.\n";
const std::string contour = "G41 D1 G1 X0 Y-10. F300.\nY40.\nX60.\nY0\nX-10.\nG40 X-20. Y-20.\n";

TEST(ProgramInfo, CountsSelectionsAcrossLiftsWithinThem) {
  EXPECT_NE(told_about(begins + contour + "M30\n").find("selections: 1, "), std::string::npos);
  EXPECT_NE(told_about(begins + contour + contour + "M30\n").find("selections: 2, "),
            std::string::npos);
  EXPECT_NE(told_about(begins + contour + "G0 Z50.\n" + contour + "M30\n").find("selections: 2, "),
            std::string::npos);
  const std::string lifted =
      "G41 D1 G1 X0 Y-10. F300.\nY40.\nG0 Z5.\nG1 Z-3.\nX60.\nY0\nX-10.\nG40 X-20. Y-20.\n";
  const std::string text = told_about(begins + lifted + "M30\n");
  EXPECT_NE(text.find("selections: 1, "), std::string::npos) << text;
}

TEST(ProgramInfo, SaysUnitsToolsAndWhatIsPassedOn) {
  const std::string text = told_about(
      "%\nO1\nG20 G90 G17 G54 (T9 G99)\nT3 M6\nS900 M3\nG0 X-1. Y-1.\nG43 H3 Z1.\n"
      "G81 X5. Z-1. R1. F9.\nG80\nG41 D1 G1 X0 Y0 F10.\nY4.\nG40 X-1.\nT4 M6\nG21\n"
      "T3 M6\nM30\n%\n");
  EXPECT_NE(text.find("unit: inch, mm (15)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("selections: 1, 3 blocks, 6.1 in\n"), std::string::npos) << text;
  EXPECT_NE(text.find("tools of the program (line): T3 (4, 2x), T4 (13)\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("passed on (line): G54 (3), M6 (4, 3x), M3 (5), G43 (7), G81 (8), G80 (9), "
                      "M30 (16)\n"),
            std::string::npos)
      << text;
  EXPECT_NE(told_about("G0 X1.\nM30\n").find("unit: mm\n"), std::string::npos);
}

TEST(ProgramInfo, SaysUnitsToolsAndWhatIsPassedOnOfKlartext) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  dialect_of(DialectName::heidenhain).begin(setup.session.program.mode);
  setup.session.program.tools = {{1, ToolRow(5)}};
  const std::string text =
      describe_program(
          "0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S900\n2 L X+0 Y+0 R0 FMAX M3\n"
          "3 CYCL DEF 9.0 DWELL\n4 CYCL DEF 9.1 DWELL 1\n5 TOOL CALL \"A B\" Z\n"
          "6 CYCL CALL M8\n7 TOOL CALL S500\n8 END PGM A INCH\n",
          setup)
          .text;
  EXPECT_NE(text.find("unit: inch\n"), std::string::npos) << text;
  EXPECT_NE(text.find("tools of the program (line): 1 (2), \"A B\" (6)\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("passed on (line): M3 (3), CYCL DEF 9 (4, 2x), CYCL CALL (7), M8 (7)\n"),
            std::string::npos)
      << text;
}

TEST(ProgramInfo, CountsNoLinesOfARefusedProgramThatComputes) {
  const std::string refused = told_about("#1=2\nG0 X#2\nX[\nM30\n");
  EXPECT_NE(refused.find("computes: yes\n"), std::string::npos) << refused;
  const std::string one = told_about("G0 X[1+1]\n");
  EXPECT_NE(one.find("computes: yes, 1 line executed\n"), std::string::npos) << one;
}

// Words that several dialects have do not outweigh a line that only one has.
TEST(ProgramInfo, SuggestsTheDialectOfItsLines) {
  EXPECT_NE(told_about("%_N_A_MPF\n;$PATH=/_N_WKS_DIR/_N_A_WPD\nN4 G00 G90 G53 D0 Z340\nM30\n")
                .find("looks like sinumerik"),
            std::string::npos);
  EXPECT_NE(told_about("N10 L CYCLE [NAME=X.NC @P1=1]\nG00 X0\nM30\n").find("looks like isg"),
            std::string::npos);
}

TEST(ProgramInfo, TellsWarningsApartFromWhatRefuses) {
  const std::string text =
      told_about(begins + "G13 I6. K12. Q3. Z-3. D1 F200.\nG41 D7 G1 X0 Y-10. F300.\nM30\n");
  const std::size_t refused = text.find("refused:");
  const std::size_t others = text.find("to look at:");
  ASSERT_NE(refused, std::string::npos) << text;
  ASSERT_NE(others, std::string::npos) << text;
  EXPECT_LT(refused, text.find("900013"));
  EXPECT_LT(text.find("900013"), others);
  EXPECT_LT(others, text.find("900227"));
}

}  // namespace
}  // namespace trc::cli
