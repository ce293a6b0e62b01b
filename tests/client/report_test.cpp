#include "client/cli/report.h"

#include <gtest/gtest.h>

#include "client/cli/info_text.h"

namespace trc::cli {
namespace {

wire::ReceivedDiagnostic reversed_line() {
  return {.diagnostic = {.code = Code::line_reversed, .source = {.number = 60, .line = 7}},
          .message = "the path runs against the contour",
          .remedy = "use a smaller tool"};
}

TEST(Report, NamesFileLineCodeMessageAndRemedy) {
  EXPECT_EQ(line_for("part.nc", reversed_line()),
            "part.nc:7: error 90019: the path runs against the contour (use a smaller tool)");
}

TEST(Report, TellsWarningsAndNotesFromErrors) {
  wire::ReceivedDiagnostic received = reversed_line();
  received.diagnostic.severity = Severity::warning;
  EXPECT_EQ(line_for("a", received).rfind("a:7: warning 90019: ", 0), 0u);
  received.diagnostic.severity = Severity::note;
  EXPECT_EQ(line_for("a", received).rfind("a:7: note 90019: ", 0), 0u);
}

TEST(Report, LeavesOutWhatIsUnknown) {
  wire::ReceivedDiagnostic received = reversed_line();
  received.diagnostic.source = {};
  received.remedy.clear();
  EXPECT_EQ(line_for("part.nc", received),
            "part.nc: error 90019: the path runs against the contour");
  received.diagnostic.column = 12;
  EXPECT_NE(line_for("part.nc", received).find(", column 12"), std::string::npos);
}

TEST(Report, KeepsControlCharactersFromTheTerminal) {
  wire::ReceivedDiagnostic received = reversed_line();
  received.message = "bad \x1B[2J word\n";
  EXPECT_EQ(line_for("p\n", received), "p?:7: error 90019: bad ?[2J word? (use a smaller tool)");
}

TEST(InfoText, MakesMarkdownTables) {
  v1::GetServerInfoResponse info;
  auto& row = *info.add_diagnostics();
  row.set_code(90019);
  row.set_severity(v1::Diagnostic::ERROR);
  row.set_cause("a | b");
  row.set_remedy("c");
  EXPECT_EQ(markdown_diagnostics(info),
            "| Code | Severity | Cause | Remedy |\n|---|---|---|---|\n"
            "| 90019 | error | a \\| b | c |\n");
  auto& keyword = *info.add_trc_keywords();
  keyword.set_name("TANGENTIAL_LIMIT");
  keyword.set_min(0.1);
  keyword.set_max(3);
  keyword.set_default_value(3);
  keyword.set_unit("degrees");
  keyword.set_available(true);
  keyword.set_meaning("turns up to this");
  auto& word = *info.add_trc_keywords();
  word.set_name("PRE");
  word.set_meaning("at selection");
  EXPECT_EQ(markdown_options(info),
            "| Option | Range | Default | Available | Meaning |\n|---|---|---|---|---|\n"
            "| TANGENTIAL_LIMIT | 0.1 … 3 degrees | 3 | yes | turns up to this |\n"
            "| PRE |  |  | no, refused | at selection |\n");
}

}  // namespace
}  // namespace trc::cli
