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
