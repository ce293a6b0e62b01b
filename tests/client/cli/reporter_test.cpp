#include "client/cli/reporter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/messages/help_by_reason.h"
#include "core/nc/dialect/dialect.h"

namespace trc::cli {
namespace {

Diagnostic warning(std::uint32_t line, const std::string& message) {
  return {.code = Code::stretch_factor_out_of_range,
          .severity = Severity::warning,
          .source = {.line = line},
          .texts = std::make_shared<const DiagnosticTexts>(
              DiagnosticTexts{.message = message, .text = message})};
}

struct Told {
  std::string text;
  std::ptrdiff_t lines = 0;
};

template <class Tell>
Told told_by(const Tell& tell) {
  Input input("/nowhere/part.nc");
  Progress progress(Progress::Result::elsewhere);
  ::testing::internal::CaptureStderr();
  {
    Reporter reporter(input, {}, progress);
    tell(reporter);
    reporter.finish();
  }
  Told told{.text = ::testing::internal::GetCapturedStderr()};
  told.lines = std::count(told.text.begin(), told.text.end(), '\n');
  return told;
}

TEST(Reporter, HelpsWithWhatTheCommandLineHas) {
  constexpr std::array<std::pair<DialectName, ControlWords>, 3> controls{
      {{DialectName::isg, ControlWords::isg},
       {DialectName::fanuc, ControlWords::g_functions},
       {DialectName::heidenhain, ControlWords::klartext}}};
  for (const CodeRow& row : code_table())
    for (const auto& [dialect, words] : controls)
      for (const Language language : {Language::english, Language::german}) {
        Diagnostic found = diagnostic(row.code, {});
        found.words = words;
        found.language = language;
        for (const SlipKind kind : {SlipKind::none, SlipKind::unit_of_another}) {
          found.slip = {.kind = kind, .instead = "G71"};
          const std::string help = texts_of(for_command_line(found, dialect)).help;
          for (const char* of_messages :
               {"SurveyRadii", "GetServerInfo", "setup", "Setup", "der Einstellungen"})
            EXPECT_EQ(help.find(of_messages), std::string::npos) << help;
        }
      }
}

// "line 4 (block 3)" in a message, and the same before it.
TEST(Reporter, NamesBlocksOfKlartextWithoutN) {
  Diagnostic found = diagnostic(Code::tool_radius_zero, {.number = 3, .line = 4});
  EXPECT_EQ(cli::text_of(for_command_line(found, DialectName::heidenhain), {.file = "a.h"})
                .find("a.h:4: block 3: warning"),
            0U);
  EXPECT_EQ(cli::text_of(for_command_line(found, DialectName::fanuc), {.file = "a.nc"})
                .find("a.nc:4: N3: warning"),
            0U);
}

TEST(Reporter, NamesTheToolThatIsMissing) {
  const auto help_for = [](const char* detail) {
    return texts_of(for_command_line(diagnostic(Code::tool_unknown, {}, detail), DialectName::isg))
        .help;
  };
  EXPECT_NE(help_for("D7").find("--set tools=7:RADIUS"), std::string::npos) << help_for("D7");
  EXPECT_NE(help_for("12").find("--set tools=12:RADIUS"), std::string::npos);
  EXPECT_NE(help_for("D9 of T1").find("--set tools=1/9:RADIUS"), std::string::npos);
  EXPECT_NE(help_for("\"MILL\"").find("--set 'tools=\"MILL\":RADIUS',"), std::string::npos)
      << help_for("\"MILL\"");
  EXPECT_NE(help_for("D2 of \"MILL\"").find("--set 'tools=\"MILL\"/2:RADIUS'"), std::string::npos);
  EXPECT_NE(help_for("\"MIL\", the table has \"MILL\"").find("'tools=\"MIL\":"), std::string::npos);
  EXPECT_NE(help_for("D9").find("--set tools=9:RADIUS"), std::string::npos);
  EXPECT_NE(help_for("5.2").find("--set tools=5/3:RADIUS"), std::string::npos) << help_for("5.2");
  EXPECT_NE(help_for("5.x").find("--set tools=NUMBER:RADIUS"), std::string::npos);
  // A table that has one tool needs the others too.
  EXPECT_NE(help_for("D7").find("that of --radius too: --set tools=7:RADIUS, once for each."),
            std::string::npos)
      << help_for("D7");
}

// A table gives no radius to a program that names no tool.
TEST(Reporter, HelpsToARadiusAsTheProgramNeedsIt) {
  const auto help_for = [](const char* detail, Language language, DialectName dialect) {
    Diagnostic found = diagnostic(Code::no_tool_radius, {}, detail);
    found.language = language;
    found.words = dialect_of(dialect).words;
    return texts_of(for_command_line(found, dialect)).help;
  };
  using enum DialectName;
  EXPECT_EQ(help_for("G41 or G42 in line 2 (N30)", Language::english, isg),
            "Give the radius: --radius 5, or a table with the tool that the program calls before "
            "G41 or G42 (--tools tools.csv, --set tools=1:5, by name --set "
            "'tools=\"MILL\":5'); if it calls none, a table does not help.");
  EXPECT_EQ(help_for("RL or RR in line 2 (N30)", Language::english, heidenhain),
            "Give the radius: --radius 5, or a table with the tool that the program calls before "
            "RL or RR (--tools tools.csv, --set tools=1:5, by name --set 'tools=\"MILL\":5'); "
            "if it calls none, a table does not help.");
  EXPECT_EQ(help_for("G41 or G42 in line 2, T2 without M06", Language::english, isg),
            "Program M06 after the T word, before G41 or G42, or give the radius: --radius "
            "5.");
  const std::string of_zero =
      help_for("G41 or G42 in line 2, D0 or T0 is no tool", Language::english, sinumerik);
  EXPECT_EQ(of_zero.find("--radius"), std::string::npos) << of_zero;
  EXPECT_NE(help_for("D1", Language::english, fanuc).find("--tools"), std::string::npos);
  EXPECT_NE(help_for("D4", Language::english, fanuc).find("--set tools=4:5, once for each."),
            std::string::npos);
  EXPECT_NE(help_for("T2 D1", Language::english, sinumerik).find("--set tools=2:5,"),
            std::string::npos);
  EXPECT_NE(help_for("T2 D3", Language::german, sinumerik).find("--set tools=2/3:5,"),
            std::string::npos);
  EXPECT_EQ(help_for("G41 or G42 in line 2", Language::german, isg).substr(0, 30),
            "Den Radius angeben: --radius 5");
}

TEST(Reporter, NamesTheFunctionThatMayPass) {
  const auto help = [](const char* detail) {
    return texts_of(for_command_line(diagnostic(Code::nc_unknown_function, {}, detail),
                                     DialectName::isg))
        .help;
  };
  EXPECT_NE(help("G777").find("--set pass_words=G777."), std::string::npos) << help("G777");
  EXPECT_NE(help("").find("--set pass_words=NAME."), std::string::npos);
}

TEST(Reporter, AllowsTheWearThatIsThere) {
  Diagnostic found = diagnostic(Code::wear_too_large, {});
  found.values = {{"wear", -3.2}, {"max_wear", 1}};
  const std::string help = texts_of(for_command_line(found, DialectName::isg)).help;
  EXPECT_NE(help.find("--set max_wear=4."), std::string::npos) << help;
}

TEST(Reporter, NamesOptionsForEveryReason) {
  for (const std::string_view reason : reasons_with_help())
    for (const Language language : {Language::english, Language::german}) {
      Diagnostic found = diagnostic(Code::nc_unsupported, {}, std::string(reason));
      found.words = ControlWords::g_functions;
      found.language = language;
      const std::string help = texts_of(for_command_line(found, DialectName::fanuc)).help;
      for (const char* field :
           {"setup", "Setup", "`dialect`", "`subprograms`", "tool_radius", "in pass_words"})
        EXPECT_EQ(help.find(field), std::string::npos) << help;
    }
}

// What is a setting of messages is an option here, and the value stands after it.
TEST(Reporter, NamesOptionsForSettings) {
  for (const CodeRow& row : code_table())
    for (const char* detail :
         {"", "FOO, a name", "EXTCALL", "a motion that may be skipped", "G41, TRC of DIN/ISO",
          "a place metres away without a decimal point: say what whole numbers count in",
          "a wear without a decimal point: say what whole numbers count in", "LX+40"})
      for (const auto& [dialect, words] :
           {std::pair(DialectName::fanuc, ControlWords::g_functions),
            std::pair(DialectName::heidenhain, ControlWords::klartext)})
        for (const Language language : {Language::english, Language::german}) {
          Diagnostic found = diagnostic(row.code, {}, detail);
          found.words = words;
          found.language = language;
          const std::string help = texts_of(for_command_line(found, dialect)).help;
          for (const char* field :
               {"options.", "`subprograms`", "`whole_numbers`", "pass_words of", "in pass_words"})
            EXPECT_EQ(help.find(field), std::string::npos) << help;
          for (const std::string field : {"contour_masking", "remove_masked_blocks", "pass_words",
                                          "block_skip", "conv_cir_to_lin", "selection_mode"})
            for (std::size_t at = help.find(field); at != help.npos; at = help.find(field, at + 1))
              EXPECT_TRUE(at >= 6 && help.compare(at - 6, 6, "--set ") == 0) << help;
        }
}

TEST(Reporter, CountsAMillionEqualMessages) {
  const Told told = told_by([](Reporter& reporter) {
    for (std::uint32_t line = 1; line <= 1'000'000; ++line) reporter.report({warning(line, "it")});
  });
  EXPECT_EQ(told.lines, 2) << told.text;
  EXPECT_NE(
      told.text.find("999999 more like it, in lines 2, 3, 4, 5, 6, 7, 8, 9 and 999991 others"),
      std::string::npos)
      << told.text;
}

TEST(Reporter, CountsCodesWhereTooManyTextsDiffer) {
  const Told told = told_by([](Reporter& reporter) {
    for (std::uint32_t line = 1; line <= 100'000; ++line)
      reporter.report({warning(line, "value " + std::to_string(line))});
    // One that was shown is counted with it.
    reporter.report({warning(100'001, "value 7")});
  });
  EXPECT_EQ(told.lines, static_cast<std::ptrdiff_t>(Reporter::most_texts) + 2);
  EXPECT_EQ(told.text.find("value 1001\n"), std::string::npos);
  EXPECT_NE(told.text.find("1 more like it, in line 100001\n"), std::string::npos);
  EXPECT_NE(
      told.text.find("warning 22007: 99000 more with this code, each in other words, in lines "
                     "1001, 1002, 1003, 1004, 1005, 1006, 1007, 1008 and 98992 others\n"),
      std::string::npos);
}

}  // namespace
}  // namespace trc::cli
