#include "core/messages/german.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "core/messages/english.h"
#include "core/messages/explanation.h"
#include "core/messages/german_detail.h"
#include "core/messages/german_explanation.h"
#include "core/messages/help_by_reason.h"
#include "core/nc/dialect/dialect.h"

namespace trc {
namespace {

// The words that no language changes: those of programs, settings and options, and numbers.
std::multiset<std::string> words_of_machine(std::string_view text) {
  static const std::regex word(
      R"(\{\w+\}|#[A-Z]+|--[a-z-]+|[A-Z]+_[A-Z_]+(=[0-9])?|\b[a-z]+(_[a-z]+)+(=\S+[0-9])?|\bG[0-9]+|\bM[0-9]+|\btrc [a-z]+|V\.G\.\S+R\b|\b(REVERSE|INVERSE|ONLINE|RMIN|I, J, K)\b)");
  const std::string whole(text);
  std::multiset<std::string> found;
  for (std::sregex_iterator at(whole.begin(), whole.end(), word), end; at != end; ++at)
    found.insert(at->str());
  return found;
}

std::set<std::string> once(const std::multiset<std::string>& words) {
  return {words.begin(), words.end()};
}

TEST(German, IsThereForEveryCode) {
  const auto rows = code_table();
  ASSERT_EQ(german_rows().size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(static_cast<int>(rows[i].code));
    const GermanRow& german = german_rows()[i];
    EXPECT_EQ(german.code, rows[i].code);
    EXPECT_FALSE(german.title.empty());
    EXPECT_FALSE(german.title.ends_with('.'));
    EXPECT_TRUE(german.help.ends_with('.'));
    EXPECT_NE(german.title, english_row_of(rows[i].code).cause);
    EXPECT_EQ(german.on_command_line.empty(),
              explanation_of(rows[i].code)->on_command_line.empty());
  }
}

TEST(German, SaysTheSameWordsOfProgramsAndSettings) {
  for (const CodeRow& row : code_table()) {
    SCOPED_TRACE(static_cast<int>(row.code));
    const GermanRow& german = german_row_of(row.code);
    EXPECT_EQ(once(words_of_machine(german.title)),
              once(words_of_machine(english_row_of(row.code).cause)));
    EXPECT_EQ(once(words_of_machine(german.help)),
              once(words_of_machine(english_row_of(row.code).remedy)));
    EXPECT_EQ(once(words_of_machine(german.on_command_line)),
              once(words_of_machine(explanation_of(row.code)->on_command_line)));
  }
}

std::size_t causes_in(const std::array<std::string_view, 3>& causes) {
  return static_cast<std::size_t>(
      std::ranges::count_if(causes, [](std::string_view cause) { return !cause.empty(); }));
}

TEST(German, ExplainsEveryCode) {
  const auto rows = code_table();
  ASSERT_EQ(german_explanations().size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(static_cast<int>(rows[i].code));
    const Explanation& english = *explanation_of(rows[i].code);
    const GermanExplanation& german = german_explanations()[i];
    EXPECT_EQ(german.code, rows[i].code);
    EXPECT_TRUE(german.meaning.ends_with('.'));
    EXPECT_NE(german.meaning, english.meaning);
    EXPECT_EQ(causes_in(german.causes), causes_in(english.causes));
    EXPECT_EQ(once(words_of_machine(german.meaning)), once(words_of_machine(english.meaning)));
    for (std::size_t cause = 0; cause < german.causes.size(); ++cause) {
      EXPECT_TRUE(german.causes[cause].empty() || german.causes[cause].ends_with('.'));
      EXPECT_EQ(once(words_of_machine(german.causes[cause])),
                once(words_of_machine(english.causes[cause])))
          << german.causes[cause];
    }
  }
  EXPECT_EQ(german_explanation_of(static_cast<Code>(123)), nullptr);
}

TEST(German, NamesEveryFunctionThatIsRefused) {
  for (const Dialect& dialect : all_dialects())
    for (const GFunction& function : dialect.functions) {
      const bool is_told = function.group == GGroup::refused || function.group == GGroup::call ||
                           function.group == GGroup::turning;
      if (!is_told) continue;
      const std::string detail = std::string("G1, ").append(function.meaning);
      EXPECT_NE(german_detail(detail), detail) << dialect.spelling;
    }
}

TEST(German, SaysWhatIsSaidOfAWord) {
  EXPECT_EQ(german_detail("G68, rotation"), "G68, Drehung");
  EXPECT_EQ(german_detail("G54 while TRC is active"), "G54 bei aktiver Werkzeugradiuskorrektur");
  EXPECT_EQ(german_detail("L, a subprogram call"), "L, ein Unterprogrammaufruf");
  EXPECT_EQ(german_detail("G21, mirroring, as in fanuc"), "G21, Spiegeln, wie bei fanuc");
  EXPECT_EQ(german_detail("X10, my own"), "X10, my own");
  EXPECT_EQ(german_detail("D2 of T1"), "D2 von T1");
  EXPECT_EQ(german_detail("G41 or G42 in line 3 (N20), D0 or T0 is no tool"),
            "G41 oder G42 in Zeile 3 (N20), D0 oder T0 ist kein Werkzeug");
  EXPECT_EQ(german_detail("REVERS, perhaps REVERSE"), "REVERS, vielleicht REVERSE");
  EXPECT_EQ(german_detail("L, from a place that is not known, while TRC is active"),
            "L, von einer Stelle aus, die nicht bekannt ist, bei aktiver Werkzeugradiuskorrektur");
}

// The first word of a detail in German that English alone has; empty: none.
std::string english_in(const std::string& detail) {
  static const std::regex english(
      R"((^|[ ,:;])(a|the|of|or|with|without|after|beside|before|which|that|no|not|words?|motion|plane|tool|contour|number|feed|call|second|third|outside|as|write|its|end|shift|setting)($|[ ,:;]))");
  const std::string german = german_detail(detail);
  std::smatch found;
  return std::regex_search(german, found, english) ? found.str() + " in: " + german : "";
}

// Functions that are refused while TRC is active.
TEST(German, NamesEveryFunctionThatHasNoPlaceInAContour) {
  for (const Dialect& dialect : all_dialects())
    for (const GFunction& function : dialect.functions) {
      constexpr std::array told{GGroup::single_move,    GGroup::cycle,      GGroup::frame,
                                GGroup::tool_data,      GGroup::unfollowed, GGroup::unfollowed_end,
                                GGroup::axis_technology};
      if (std::ranges::find(told, function.group) == told.end()) continue;
      const std::string detail = std::string(function.meaning);
      EXPECT_NE(german_detail(detail), detail) << dialect.spelling;
      EXPECT_EQ(english_in(detail + " while TRC is active"), "") << dialect.spelling;
    }
}

// The longest piece of a detail that is known is translated, not single words of it.
TEST(German, SaysNothingInTwoLanguages) {
  for (const char* const detail :
       {"#, a second assignment: one in a block",
        "$BREAK outside of a loop",
        "T3, a third tool of its line",
        "DC, ACP or ACN, a way round, beside a contour",
        "CC, an arc or a pole across the plane",
        "X, beside the contour since G40 without motion",
        "CC with an axis that turns",
        "CT after a motion of the contour: program its centre",
        "DPRNT without the places of its value",
        "G110 after G40 without motion",
        "G50 with S, a limit of the speed",
        "RND or CHF before the motion that selects TRC",
        "a rounding or a chamfer before the motion that selects TRC",
        "a feed that is no number per minute",
        "a motion of one axis after a deselection without motion",
        "a second TURN=",
        "a second rounding or chamfer",
        "P3, a second count of a call",
        "a contour of a cycle that computes",
        "a contour of a cycle that the program runs through",
        "a contour of a cycle after a program without M30",
        "M109, no feed per minute, while TRC is active",
        "V.G.WZ[ ] beside other words: write it into a line of its own",
        "a step of 0",
        "a stop beside RND",
        "$GOTO after words of a block",
        "G147 beside words of an arc, a rounding or a chamfer",
        "words after a call",
        "M73, modes as they were before a subprogram",
        "Y+Q1, a variable, while TRC is active",
        "TRC under a frame that scales, in line 4",
        "a call of what only the machine has while TRC is active",
        "the number of a parameter",
        "S2, with the number of a spindle",
        "T2, the tool of another spindle",
        "G21, mm of the ISO mode: write G71, or declare the dialect FANUC"})
    EXPECT_EQ(english_in(detail), "");
}

TEST(German, HelpsForEveryReason) {
  for (const std::string_view reason : reasons_with_help()) {
    const std::string_view english = help_by_reason(reason, Language::english);
    const std::string_view german = help_by_reason(reason, Language::german);
    EXPECT_TRUE(english.ends_with('.')) << reason;
    EXPECT_TRUE(german.ends_with('.')) << reason;
    EXPECT_NE(english, german) << reason;
    EXPECT_EQ(once(words_of_machine(german)), once(words_of_machine(english))) << reason;
  }
}

TEST(German, OfMessageAndHelp) {
  Diagnostic found = diagnostic(Code::bottleneck, {.index = 3});
  found.values = {{"clearance", 2}, {"tool_radius", 5}};
  append_place(found.values, "other", {.index = 8, .number = 70, .line = 7});
  EXPECT_EQ(message_of(found, Language::german),
            "Engstelle: das Werkzeug kommt einem anderen Satz der Kontur näher als sein Radius "
            "(Abstand 2.000 mm, Werkzeugradius 5.000 mm, anderer Satz Zeile 7 (N70))");
  EXPECT_EQ(help_of(found, Language::german),
            "Einen kleineren Fräser nehmen oder die Kontur berichtigen.");
}

TEST(German, NamesBlocksAsTheProgramDoes) {
  Diagnostic found = diagnostic(Code::selection_point_too_near, {.index = 3});
  found.values = {{"selection_block", 40}, {"distance", 28.284}};
  EXPECT_TRUE(
      message_of(found, Language::german).ends_with(" (Anwahlsatz N40, Abstand 28.284 mm)"));
  EXPECT_TRUE(message_of(found).ends_with(" (selection block N40, distance 28.284 mm)"));
  found.values.clear();
  append_place(found.values, "selection", {.index = 3, .line = 4});
  EXPECT_TRUE(message_of(found, Language::german).ends_with(" (Anwahlsatz Zeile 4)"));
  EXPECT_TRUE(message_of(found).ends_with(" (selection block line 4)"));
}

TEST(German, OfEverySlipNamesWhatWasMeant) {
  for (const SlipKind kind :
       {SlipKind::decimal_comma, SlipKind::letter_o, SlipKind::letter_l, SlipKind::other_keyboard,
        SlipKind::quotes, SlipKind::unit_of_another}) {
    Diagnostic found = diagnostic(Code::nc_number, {});
    found.slip = {.kind = kind, .instead = "X10.5"};
    EXPECT_NE(help_of(found).find("X10.5"), std::string::npos);
    EXPECT_NE(help_of(found, Language::german).find("X10.5"), std::string::npos);
    EXPECT_NE(help_of(found), help_of(found, Language::german));
    EXPECT_EQ(help_of(found).find('{'), std::string::npos);
  }
}

}  // namespace
}  // namespace trc
