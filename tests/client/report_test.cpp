#include "client/cli/report.h"

#include <gtest/gtest.h>

#include <memory>

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

EntryHelp quarter_circle_help() {
  EntryHelp help{.given_length = 3,
                 .needed_length = 5,
                 .tried_on = 2,
                 .legal = DiagnosticPoint{.x = -5, .y = 12.7, .z = 2}};
  help.proposals.push_back({.shape = EntryProposal::Shape::quarter_circle,
                            .start = {.x = 5, .y = 25.4, .z = 2},
                            .blocks = {{.end = {.x = -20.4, .y = 25.4, .z = 0}},
                                       {.end = {.x = 5, .y = 0, .z = 0},
                                        .center = DiagnosticPoint{.x = 5, .y = 25.4, .z = 0},
                                        .sweep = 1.5707963}}});
  return help;
}

TEST(EntryHelpText, SaysWhatWouldDoInWordsAndInLines) {
  const auto lines = lines_of(quarter_circle_help(), {});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            "the approach is 3.000 mm long and needs at least 5.000 mm; it may start at X-5 Y12.7");
  EXPECT_EQ(lines[1],
            "proposed entry, quarter circle, in mm: G0 X5 Y25.4, G1 X-20.4 Y25.4 Z0 with G41 or "
            "G42 as before, G3 X5 Y0 R25.4, G1");
}

TEST(EntryHelpText, WritesAsTheProgramIsWritten) {
  EntryHelp help = quarter_circle_help();
  EXPECT_EQ(lines_of(help, {.dialect = DialectName::fanuc, .inch = true})[1],
            "proposed entry, quarter circle, in inch: G0 X0.19685 Y1., G1 X-0.80315 Y1. Z0. with "
            "G41 or G42 as before, G3 X0.19685 Y0. R1., G1");
  EXPECT_NE(lines_of(help, {.dialect = DialectName::sinumerik})[1].find("CR=25.4"),
            std::string::npos);
  EXPECT_EQ(lines_of(help, {.dialect = DialectName::heidenhain}).size(), 1U);
  help.leaves = true;
  help.needed_length = 0;
  help.third_axis = 1;
  help.legal = DiagnosticPoint{.x = 1, .y = 7, .z = -0.00001};
  help.proposals.clear();
  EXPECT_EQ(lines_of(help, {}),
            std::vector<std::string>{"the retract is 3.000 mm long; it may end at X1 Z0"});
}

TEST(EntryHelpText, NamesTheLeadsThatHaveToGo) {
  EntryHelp help = quarter_circle_help();
  help.needed_length = 0;
  help.legal.reset();
  help.replaced = 1;
  EXPECT_EQ(lines_of(help, {})[0],
            "what leads to the contour has to be another one: replace the approach and the block "
            "behind it, as leads");
  help.replaced = 2;
  help.left_out = 3;
  EXPECT_EQ(lines_of(help, {})[0],
            "what leads to the contour has to be another one: replace the approach and the 2 "
            "blocks behind it, as leads, and leave out the last 3 blocks before G40");
}

TEST(EntryHelpText, SaysNothingWhereNothingIsKnown) {
  EXPECT_TRUE(lines_of({.given_length = 3}, {}).empty());
  EXPECT_TRUE(help_lines_for("part.nc", reversed_line().diagnostic, {}).empty());
}

TEST(EntryHelpText, StandsBehindPlaceAndCode) {
  Diagnostic refused = diagnostic(Code::selection_block_too_short, {.line = 7});
  refused.entry_help = std::make_shared<const EntryHelp>(quarter_circle_help());
  const auto lines = help_lines_for("part.nc", refused, {});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].rfind("part.nc:7: help 900201: the approach is ", 0), 0U) << lines[0];
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
