#include "client/cli/report.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "client/cli/info_text.h"

namespace trc::cli {
namespace {

struct Sent {
  Diagnostic diagnostic{};
  DiagnosticTexts texts{};
};

Sent reversed_line() {
  return {.diagnostic = {.code = Code::line_reversed, .source = {.number = 60, .line = 7}},
          .texts = {.text = "the path runs against the contour", .help = "use a smaller tool"}};
}

std::string text_of(Sent sent, const Shown& shown) {
  sent.diagnostic.texts = std::make_shared<const DiagnosticTexts>(sent.texts);
  return text_of(sent.diagnostic, shown);
}

// What is said of a diagnostic without its line of the program.
std::string alone(std::string_view file, const Sent& received) {
  return text_of(received, {.file = file});
}

TEST(Report, NamesFileLineNumberCodeMessageAndRemedy) {
  EXPECT_EQ(alone("part.nc", reversed_line()),
            "part.nc:7: N60: error 90019: the path runs against the contour\n"
            "help: use a smaller tool\n");
}

TEST(Report, SpeaksTheLanguageOfTheMessage) {
  Sent received = reversed_line();
  received.diagnostic.language = Language::german;
  received.texts.text = "das Werkzeug passt nicht";
  received.texts.help = "Einen kleineren Fräser nehmen.";
  EXPECT_EQ(alone("part.nc", received),
            "part.nc:7: N60: Fehler 90019: das Werkzeug passt nicht\n"
            "Hilfe: Einen kleineren Fräser nehmen.\n");
  Counted like;
  for (int k = 0; k < 2; ++k) like.add(received.diagnostic);
  EXPECT_EQ(more_like(like, {.file = "part.nc"}),
            "part.nc: Fehler 90019: 2 weitere gleiche, in Zeilen 7 (N60), 7 (N60)\n");
}

TEST(Report, TellsWarningsAndNotesFromErrors) {
  Sent received = reversed_line();
  received.diagnostic.severity = Severity::warning;
  EXPECT_EQ(alone("a", received).rfind("a:7: N60: warning 90019: ", 0), 0u);
  received.diagnostic.severity = Severity::note;
  EXPECT_EQ(alone("a", received).rfind("a:7: N60: note 90019: ", 0), 0u);
}

TEST(Report, LeavesOutWhatIsUnknown) {
  Sent received = reversed_line();
  received.diagnostic.source = {};
  received.texts.help.clear();
  EXPECT_EQ(alone("part.nc", received),
            "part.nc: error 90019: the path runs against the contour\n");
}

TEST(Report, MarksTheWordInItsLine) {
  Sent received = reversed_line();
  received.diagnostic.column = 9;
  EXPECT_EQ(text_of(received, {.file = "p", .source_line = "N60 G02 X-40.5 I25"}),
            "p:7:9: N60: error 90019: the path runs against the contour\n"
            "    7 | N60 G02 X-40.5 I25\n"
            "      |         ^~~~~~\n"
            "help: use a smaller tool\n");
}

TEST(Report, FindsTheWordAtFaultWhereTheLineHasItOnce) {
  Sent received = reversed_line();
  received.diagnostic.detail = "G187 P2";
  EXPECT_NE(
      text_of(received, {.file = "p", .source_line = "N60 G187 P2 X1"}).find("p:7:5: N60: error"),
      std::string::npos);
  EXPECT_NE(
      text_of(received, {.file = "p", .source_line = "N60 G187 P2 X1"}).find("|     ^~~~~~~\n"),
      std::string::npos);
  received.diagnostic.detail = "X1";
  EXPECT_NE(text_of(received, {.file = "p", .source_line = "X1 X1"}).find("p:7: N60: error"),
            std::string::npos);
}

TEST(Report, MarksTheWordThatTheDetailSaysSomethingOf) {
  Sent received = reversed_line();
  received.diagnostic.column = 5;
  received.diagnostic.detail = "TRANS, an expression or a name";
  EXPECT_NE(text_of(received, {.file = "p", .source_line = "N60 TRANS X1"}).find("|     ^~~~~\n"),
            std::string::npos);
}

TEST(Report, MarksNamesAndValuesWhole) {
  const auto mark_in = [](const std::string& line) {
    Sent received = reversed_line();
    received.diagnostic.column = 5;
    received.diagnostic.detail = "a frame";
    const std::string text = text_of(received, {.file = "p", .source_line = line});
    const std::size_t at = text.find('^');
    return at == text.npos ? std::string() : text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(mark_in("N60 TRANS X1"), "^~~~~");
  EXPECT_EQ(mark_in("N60 CYCLE81(1,2)"), "^~~~~~~");
  EXPECT_EQ(mark_in("N60 T=\"MILL 5\" D1"), "^~~~~~~~~~");
  EXPECT_EQ(mark_in("N60 AR=40.5 X1"), "^~~~~~~");
  EXPECT_EQ(mark_in("N60 V.G.WZ_AKT.R=3"), "^~~~~~~~~~~~~~");
  EXPECT_EQ(mark_in("N60 $IF 1"), "^~~");
  EXPECT_EQ(mark_in("N60 X40.5Y2"), "^~~~~");
}

TEST(Report, CountsCharactersNotBytesAndKeepsTheMarkUnderTabs) {
  Sent received = reversed_line();
  received.diagnostic.column = 9;
  EXPECT_NE(text_of(received, {.file = "p", .source_line = "\t(\xC3\xB8 12) X5"})
                .find("    7 |  (\xC3\xB8 12) X5\n      |        ^\n"),
            std::string::npos)
      << text_of(received, {.file = "p", .source_line = "\t(\xC3\xB8 12) X5"});
}

TEST(Report, ShowsLatin1AsTheLettersItIs) {
  Sent received = reversed_line();
  received.diagnostic.column = 8;
  const std::string text = text_of(received, {.file = "p", .source_line = "1 ;\x80\xC4\xD6 T5"});
  EXPECT_NE(text.find("    7 | 1 ;?ÄÖ T5\n      |        ^~\n"), std::string::npos) << text;
}

TEST(Report, ShowsThePartOfALongLineThatMatters) {
  Sent received = reversed_line();
  received.diagnostic.column = 501;
  const std::string text = text_of(
      received, {.file = "p", .source_line = std::string(500, 'a') + "X5" + std::string(500, 'b')});
  const std::size_t line = text.find("    7 | …");
  ASSERT_NE(line, std::string::npos) << text;
  EXPECT_NE(text.find("X5bbb"), std::string::npos);
  EXPECT_LT(text.size(), 400U);
  const std::size_t mark = text.find('^');
  const std::size_t above = text.find("X5");
  const auto column_in_line = [&](std::size_t at) { return at - text.rfind('\n', at); };
  // The sign that stands for what is left out has three bytes.
  EXPECT_EQ(column_in_line(mark), column_in_line(above) - 2) << text;
}

TEST(Report, KeepsControlCharactersFromTheTerminal) {
  Sent received = reversed_line();
  received.texts.text = "bad \x1B[2J word\n \xC2\x9B \xFF";
  EXPECT_EQ(text_of(received, {.file = "p\n", .source_line = "\x1B[2J\xFFX"}),
            "p?:7: N60: error 90019: bad ?[2J word? ? ÿ\n    7 | ?[2JÿX\n"
            "help: use a smaller tool\n");
}

TEST(Report, KeepsTheDirectionOfWriting) {
  Sent received = reversed_line();
  received.texts.text = "a\u202Eb\u2066c\u200F \u2300";
  EXPECT_EQ(alone("p", received),
            "p:7: N60: error 90019: a?b?c? \u2300\nhelp: use a smaller tool\n");
}

TEST(Report, PaintsOnlyWhenAsked) {
  const Shown shown{.file = "p", .source_line = "X5", .in_colour = true};
  EXPECT_NE(text_of(reversed_line(), shown).find("\x1b[1;31merror 90019:\x1b[0m"),
            std::string::npos);
  EXPECT_EQ(alone("p", reversed_line()).find('\x1b'), std::string::npos);
}

TEST(Report, CountsWhatWasToldBefore) {
  Counted counted;
  for (std::uint32_t line = 8; line < 20; ++line)
    counted.add({.code = Code::stretch_factor_out_of_range,
                 .severity = Severity::warning,
                 .source = {.number = line * 10, .line = line}});
  EXPECT_EQ(more_like(counted, {.file = "p"}),
            "p: warning 22007: 12 more like it, in lines 8 (N80), 9 (N90), 10 (N100), 11 (N110), "
            "12 (N120), 13 (N130), 14 (N140), 15 (N150) and 4 others\n");
  Counted one;
  one.add({.code = Code::stretch_factor_out_of_range,
           .severity = Severity::warning,
           .source = {.line = 8}});
  EXPECT_EQ(more_like(one, {.file = "p"}), "p: warning 22007: 1 more like it, in line 8\n");
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
  EXPECT_EQ(lines_of(help, {.dialect = DialectName::heidenhain})[1],
            "proposed entry, quarter circle, in mm: L X+5 Y+25.4 R0 FMAX, L X-20.4 Y+25.4 Z+0 with "
            "RL or RR as before, CR X+5 Y+0 R+25.4 DR+");
  help.leaves = true;
  help.needed_length = 0;
  help.third_axis = 1;
  help.legal = DiagnosticPoint{.x = 1, .y = 7, .z = -0.00001};
  help.proposals.clear();
  EXPECT_EQ(lines_of(help, {}),
            std::vector<std::string>{"the retract is 3.000 mm long; it may end at X1 Z0"});
}

TEST(EntryHelpText, SaysLengthsInTheUnitOfTheProgram) {
  EXPECT_EQ(lines_of(quarter_circle_help(), {.inch = true})[0],
            "the approach is 0.1181 in long and needs at least 0.1969 in; it may start at "
            "X-0.19685 Y0.5");
}

TEST(EntryHelpText, IsThereInGerman) {
  EntryHelp help = quarter_circle_help();
  const Writing german{.language = Language::german};
  EXPECT_EQ(lines_of(help, german)[0],
            "der Anfahrsatz ist 3.000 mm lang und braucht mindestens 5.000 mm; er darf beginnen "
            "bei X-5 Y12.7");
  EXPECT_TRUE(
      lines_of(help, german)[1].starts_with("Vorschlag zum Anfahren, Viertelkreis, in mm: "
                                            "G0 X5"));
  help.needed_length = 0;
  help.legal.reset();
  help.replaced = 1;
  help.left_out = 3;
  EXPECT_EQ(lines_of(help, german)[0],
            "zur Kontur muss ein anderer Weg führen: den Anfahrsatz ersetzen, dazu den Satz "
            "dahinter, der anfährt, und die letzten 3 Sätze vor G40 weglassen");
}

TEST(EntryHelpText, NamesTheLeadsThatHaveToGo) {
  EntryHelp help = quarter_circle_help();
  help.needed_length = 0;
  help.legal.reset();
  help.replaced = 1;
  EXPECT_EQ(lines_of(help, {})[0],
            "what leads to the contour has to be another one: replace the approach and the block "
            "after it, as leads");
  help.replaced = 2;
  help.left_out = 3;
  EXPECT_EQ(lines_of(help, {})[0],
            "what leads to the contour has to be another one: replace the approach and the 2 "
            "blocks after it, as leads, and leave out the last 3 blocks before G40");
}

TEST(EntryHelpText, SaysNothingWhereNothingIsKnown) {
  EXPECT_TRUE(lines_of({.given_length = 3}, {}).empty());
}

TEST(EntryHelpText, StandsAfterTheRemedy) {
  Sent received = reversed_line();
  received.diagnostic.entry_help = std::make_shared<const EntryHelp>(quarter_circle_help());
  EXPECT_NE(alone("part.nc", received).find("help: use a smaller tool\nhelp: the approach is "),
            std::string::npos);
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
