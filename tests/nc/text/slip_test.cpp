#include "core/nc/text/slip.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "tests/nc/dialect/reading.h"

namespace trc::testing {
namespace {

struct Slipped {
  const char* line;
  const char* place_and_code;  // of the first diagnostic
  const char* word;
  SlipKind kind = SlipKind::none;
  const char* instead;
};

std::ostream& operator<<(std::ostream& out, const Slipped& slipped) { return out << slipped.line; }

// ISG, and those of plain letters and numbers, of names and of Klartext.
constexpr auto dialects = {DialectName::isg, DialectName::fanuc, DialectName::linuxcnc,
                           DialectName::sinumerik};

class SlipOfTyping : public ::testing::TestWithParam<Slipped> {};

TEST_P(SlipOfTyping, IsNamedInEveryDialect) {  // D-46
  const Slipped& slipped = GetParam();
  for (const DialectName name : dialects) {
    SCOPED_TRACE(dialect_of(name).spelling);
    const Reading reading = read(slipped.line, {.dialect = name});
    ASSERT_FALSE(reading.diagnostics.empty());
    EXPECT_EQ(reading.diagnostics.size(), 1U) << "the rest of the word is told with it";
    const Diagnostic& found = reading.diagnostics.front();
    EXPECT_EQ(place_and_code(found), slipped.place_and_code) << message_of(found);
    EXPECT_EQ(found.detail, slipped.word);
    EXPECT_EQ(found.slip.kind, slipped.kind);
    EXPECT_EQ(found.slip.instead, slipped.instead);
    EXPECT_NE(help_of(found).find(slipped.instead), std::string::npos) << help_of(found);
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfAWord, SlipOfTyping,
    ::testing::Values(
        Slipped{"N10 G1 X10,5 Y2", "1:8 900008", "X10,5", SlipKind::decimal_comma, "X10.5"},
        Slipped{"G1 X-0,25", "1:4 900008", "X-0,25", SlipKind::decimal_comma, "X-0.25"},
        Slipped{"G1 X10 YO", "1:8 900008", "YO", SlipKind::letter_o, "Y0"},
        Slipped{"G1 X+O Y2", "1:4 900008", "X+O", SlipKind::letter_o, "X+0"},
        Slipped{"G1 X10 Y-O", "1:8 900008", "Y-O", SlipKind::letter_o, "Y-0"},
        Slipped{"GO1 X10", "1:1 900008", "GO1", SlipKind::letter_o, "G01"},
        Slipped{"N10 GO X10", "1:5 900008", "GO", SlipKind::letter_o, "G0"},
        Slipped{"G0l X10", "1:1 900008", "G0l", SlipKind::letter_l, "G01"},
        Slipped{"G1 X-O.5", "1:4 900008", "X-O.5", SlipKind::letter_o, "X-0.5"},
        Slipped{"G1 X4O. Y5", "1:4 900008", "X4O.", SlipKind::letter_o, "X40."},
        Slipped{"G1 X\u221210.5 Y3", "1:4 900008", "X\u221210.5", SlipKind::other_keyboard,
                "X-10.5"},
        Slipped{"G1 X\u201310", "1:4 900008", "X\u201310", SlipKind::other_keyboard, "X-10"},
        Slipped{"G1 X\uFF11\uFF10", "1:4 900008", "X\uFF11\uFF10", SlipKind::other_keyboard,
                "X10"}));

TEST(SlipOfTyping, IsNamedInKlartext) {
  const auto first = [](const std::string& line) {
    const Reading reading =
        read("BEGIN PGM A MM\n" + line + "\n", {.dialect = DialectName::heidenhain});
    EXPECT_FALSE(reading.diagnostics.empty());
    return reading.diagnostics.empty() ? Diagnostic{} : reading.diagnostics.front();
  };
  // A decimal comma is none.
  EXPECT_EQ(first("L X+10,5 Y+1,000.5 R0 F500").detail, "Y+1,000.5, two decimal signs");
  EXPECT_EQ(first("L X+10,5 Y+0 R0 F0,0").slip.kind, SlipKind::none);
  EXPECT_EQ(first("L X+1O Y+0 R0 F500").slip.instead, "X+10");
  EXPECT_EQ(first("L X\u221210 Y+0 R0 F500").slip.instead, "X-10");
  EXPECT_EQ(first("L X+O Y-20 R0 F500").slip.instead, "X+0");
  EXPECT_EQ(first("L IX+O Y-20 R0 F500").slip.instead, "IX+0");
  EXPECT_EQ(first("L IX-1O Y-20 R0 F500").slip.instead, "IX-10");
  EXPECT_EQ(read("BEGIN PGM A MM\nL IX+O Y-20 R0 F500\n", {.dialect = DialectName::heidenhain})
                .diagnostics.size(),
            1U);
}

TEST(SlipOfTyping, OfQuotesInSinumerik) {
  const Reading reading = read("T=\u201EMILL10\u201C\nM6", {.dialect = DialectName::sinumerik});
  ASSERT_FALSE(reading.diagnostics.empty());
  EXPECT_EQ(reading.diagnostics.front().slip.kind, SlipKind::quotes);
  EXPECT_EQ(reading.diagnostics.front().slip.instead, "T=\"MILL10\"");
}

TEST(SlipOfTyping, IsNotSeenInWhatMayBeMeant) {
  const auto slip_in = [](std::string_view line, std::size_t at) {
    return slip_at(line, at).has_value();
  };
  EXPECT_FALSE(slip_in("GOTO 10", 0));
  EXPECT_FALSE(slip_in("GOTO10", 0));
  EXPECT_FALSE(slip_in("WHILE [#1 LT 3] DO1", 16));
  EXPECT_FALSE(slip_in("g10l2p1", 0));
  EXPECT_FALSE(slip_in("g10l2p1", 3));
  EXPECT_FALSE(slip_in("CALL(1,5)", 0));
  EXPECT_FALSE(slip_in("X10 ,R5", 4));
  EXPECT_FALSE(slip_in("X10,R5", 3));
  EXPECT_FALSE(slip_in("POLY", 0));
  EXPECT_FALSE(slip_in("ROT RPL=45", 0));
  EXPECT_FALSE(slip_in("L10", 0));
  EXPECT_FALSE(slip_in("", 0));
}

TEST(SlipOfTyping, NeverReadsBeyondALine) {
  const std::string signs = "GXOl0,.-= (\"\u2212\uFF11\xE2";
  for (std::size_t first = 0; first < signs.size(); ++first)
    for (std::size_t last = first; last <= signs.size(); ++last)
      for (std::size_t at = 0; at < last - first; ++at) {
        const std::string line(signs, first, last - first);
        const auto found = slip_at(line, at);
        if (!found) continue;
        EXPECT_LE(found->begin, at) << line;
        EXPECT_EQ(line.compare(found->begin, found->word.size(), found->word), 0) << line;
        EXPECT_NE(found->slip.instead, found->word) << line;
      }
}

TEST(ForeignWord, IsNamedWhole) {
  const Reading reading = read("N10 TRANS X10", {});
  ASSERT_FALSE(reading.diagnostics.empty());
  EXPECT_TRUE(reading.diagnostics.front().detail.starts_with("TRANS,"))
      << reading.diagnostics.front().detail;
}

TEST(UnitOfAnother, SaysHowIsgCountsInMm) {
  const Reading reading = read("G21 X10", {});
  ASSERT_FALSE(reading.diagnostics.empty());
  const std::string help = help_of(reading.diagnostics.front());
  EXPECT_NE(help.find("G71"), std::string::npos) << help;
  EXPECT_NE(help.find("--dialect fanuc"), std::string::npos) << help;
}

// Nothing else looks like it, so that a wrong --dialect is named as such.
TEST(WrongDialect, IsSaidOfKlartextWhateverIsDeclared) {
  for (const DialectName name : dialects) {
    SCOPED_TRACE(dialect_of(name).spelling);
    const Reading reading =
        read("0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S2000\n2 L X-20 Y-20 R0 FMAX\n", {.dialect = name});
    ASSERT_FALSE(reading.diagnostics.empty());
    EXPECT_EQ(reading.diagnostics.front().code, Code::other_dialect);
    EXPECT_TRUE(reading.diagnostics.front().detail.ends_with(", as in heidenhain"))
        << reading.diagnostics.front().detail;
  }
}

}  // namespace
}  // namespace trc::testing
