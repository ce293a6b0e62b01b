#include "core/nc/text/words.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "core/nc/text/expression.h"
#include "tests/support/long_run.h"

namespace trc {
namespace {

// The words of a line as text: "G1 N10 | comment …".
std::string words_of(std::string_view line) {
  WordReader reader(line);
  std::string text;
  for (;;) {
    const Word word = reader.next();
    if (word.kind == WordKind::end) return text;
    if (!text.empty()) text += " ";
    if (word.kind == WordKind::fault)
      return text + "fault " + std::to_string(static_cast<int>(reader.fault().code)) + " at " +
             std::to_string(reader.fault().begin);
    char shown[64];
    switch (word.kind) {
      case WordKind::address:
        std::snprintf(shown, sizeof shown, "%c%.17g", word.letter, word.value);
        text += shown;
        if (word.has_argument) {
          std::snprintf(shown, sizeof shown, "=%.17g", word.argument);
          text += shown;
        }
        break;
      case WordKind::number:
      case WordKind::variable:
        std::snprintf(shown, sizeof shown, "%s%.17g",
                      word.kind != WordKind::variable ? ""
                      : word.relative                 ? "radius+="
                                                      : "radius=",
                      word.value);
        text += shown;
        break;
      default:
        text += std::string(line.substr(word.begin, word.end - word.begin));
    }
  }
}

TEST(Words, NeedNoBlanksBetweenThem) {
  EXPECT_EQ(words_of("N10G01X10.5Y-3F1000M8"), "N10 G1 X10.5 Y-3 F1000 M8");
}

TEST(Words, MayHaveBlanksAndAnEqualSignInsideThem) {
  EXPECT_EQ(words_of("G 01  X = 10\tY= -.5 Z 3."), "G1 X10 Y-0.5 Z3");
}

// A `/` marks a line to be skipped at its beginning alone.
TEST(Words, MayBeComputedAfterTheirSign) {
  EXPECT_EQ(words_of("G1 X=100/2 Y=4 + 5 Z-2"), "G1 X50 Y9 Z-2");
  EXPECT_EQ(words_of("X=10 Y=2**3-1"), "X10 Y7");
}

TEST(Words, AreTheSameInLowerCase) { EXPECT_EQ(words_of("n10 g1 x5"), "N10 G1 X5"); }

TEST(Words, TakeASignAndAPointWithoutDigitsOnOneSide) {
  EXPECT_EQ(words_of("X+3 Y-.5 Z5. A.25"), "X3 Y-0.5 Z5 A0.25");
}

TEST(Words, KeepTheNumberAfterAnIndexedAddress) {
  EXPECT_EQ(words_of("G159=3 S2=500 X1 = -4"), "G159=3 S2=500 X1=-4");
}

TEST(Words, TheToolRadiusHasTwoNames) {
  EXPECT_EQ(words_of("V.G.WZ_AKT.R = 10"), "radius=10");
  EXPECT_EQ(words_of("v.g.wzr=-2.5 G41"), "radius=-2.5 G41");
}

TEST(Words, TheToolRadiusMayBeChangedByANumber) {
  EXPECT_EQ(words_of("V.G.WZ_AKT.R = V.G.WZ_AKT.R + 0.25"), "radius+=0.25");
  EXPECT_EQ(words_of("v.g.wzr=v.g.wzr-.5 G41"), "radius+=-0.5 G41");
  for (const char* other : {"V.G.WZR=V.G.WZ_AKT.R+1", "V.G.WZR=V.G.WZR", "V.G.WZR=V.G.WZR*2",
                            "V.G.WZR=V.G.WZR+P1", "V.G.WZR=V.G.WZR+1+1", "V.G.WZR=V.G.WZR+-1"})
    EXPECT_EQ(words_of(other), "fault 900003 at 0") << other;
}

TEST(Words, VIsAnAxisWhenADigitFollows) { EXPECT_EQ(words_of("V10 W.5"), "V10 W0.5"); }

TEST(Words, ANumberWithoutLetterIsAWordOfItsOwn) {
  EXPECT_EQ(words_of("G04 2.13"), "G4 2.1299999999999999");
}

TEST(Words, CommentsNestAndEndInTheirLine) {
  EXPECT_EQ(words_of("X1 (a (b) c) Y2"), "X1 (a (b) c) Y2");
  EXPECT_EQ(words_of("X1 (open Y2"), "X1 fault 900009 at 3");
  EXPECT_EQ(words_of("X1 (open (b) Y2"), "X1 fault 900009 at 3");
  EXPECT_EQ(words_of("X1 (open \\\nY2)"), "X1 fault 900009 at 3");
  EXPECT_EQ(words_of("X1 ;a (b Y2"), "X1 ;a (b Y2");
}

TEST(Words, OneClosingParenthesisTooManyBelongsToTheComment) {
  EXPECT_EQ(words_of("G140 (Deactivate))"), "G140 (Deactivate))");
}

TEST(Words, ACommandReachesToTheCommentAfterIt) {
  EXPECT_EQ(words_of("N10 #TRC [REVERSE=1] (on)"), "N10 #TRC [REVERSE=1] (on)");
  EXPECT_EQ(words_of("#MSG [\"a;b (c\"];d"), "#MSG [\"a;b (c\"] ;d");
}

TEST(Words, AContinuedLineIsOneLine) {
  EXPECT_EQ(words_of("G01 \\\r\nN20 X10 \\ \nY5"), "G1 N20 X10 Y5");
}

TEST(Words, ABackslashElsewhereIsAFault) {
  EXPECT_EQ(words_of("G01 \\ X10"), "G1 fault 900001 at 4");
}

TEST(Words, ANoBreakSpaceIsABlank) {
  EXPECT_EQ(words_of("\u00a0N10\u00a0G1 X \u00a05\u00a0=\u00a02 \\\u00a0\nY\u00a01\u00a0"),
            words_of(" N10 G1 X  5 = 2 \\ \nY 1 "));
  EXPECT_EQ(words_of("#TRC\u00a0[REVERSE=1]\u00a0"), "#TRC\u00a0[REVERSE=1]");
  EXPECT_EQ(words_of("#MSG voil\u00e0 "), "#MSG voil\u00e0");
  EXPECT_TRUE(is_continued("G1 X10 \\\u00a0"));
}

std::string detail_of(std::string_view line) {
  WordReader reader(line);
  while (true) {
    const Word word = reader.next();
    if (word.kind == WordKind::fault) return reader.fault().detail;
    if (word.kind == WordKind::end) return {};
  }
}

TEST(Words, CharactersThatCannotBeSeenAreNamed) {
  EXPECT_EQ(detail_of("G1 \u200bX5"), "U+200B, a zero width space, which cannot be seen");
  EXPECT_EQ(detail_of("G1 X\u200b5"), "X before U+200B, a zero width space, which cannot be seen");
  EXPECT_EQ(detail_of("G1 X\u22125"),
            "X before U+2212, a minus sign that is not the one of the keyboard");
  EXPECT_EQ(detail_of("G1 X5 \x07"), "U+0007, a control character");
  EXPECT_EQ(detail_of("G1 X5 \u00e4"), "\u00e4, U+00E4");
  EXPECT_EQ(detail_of("G1 X5 &"), "&");
  EXPECT_EQ(detail_of("G1 X5 \xC3"), "no UTF-8");
}

TEST(Words, ANumberThatIsMissingOrBrokenIsAFaultAtItsLetter) {
  EXPECT_EQ(words_of("G01 X"), "G1 fault 900008 at 4");
  EXPECT_EQ(words_of("X Y10"), "fault 900008 at 0");
  EXPECT_EQ(words_of("X--3"), "fault 900008 at 0");
  EXPECT_EQ(words_of("X."), "fault 900008 at 0");
  EXPECT_EQ(words_of("X1.2.3"), "X1.2 0.29999999999999999");  // refused as a number without letter
}

TEST(Words, ANumberLargerThanAnyDoubleIsAFault) {
  EXPECT_EQ(words_of(std::string("X").append(400, '9')), "fault 900008 at 0");
}

TEST(Words, EIsNoExponent) { EXPECT_EQ(words_of("X1E3"), "X1 E3"); }

TEST(Words, ExpressionsAndVariablesAreRefusedAtTheirPlace) {
  EXPECT_EQ(words_of("G1 X[1+2]"), "G1 fault 900003 at 3");
  EXPECT_EQ(words_of("XP1"), "fault 900003 at 0");
  EXPECT_EQ(words_of("X=V.L.A"), "fault 900003 at 0");
  EXPECT_EQ(words_of("P1=5"), "fault 900003 at 0");
  EXPECT_EQ(words_of("V.P.X=5"), "fault 900003 at 0");
  EXPECT_EQ(words_of("V.G.WZ_AKT.R=P5"), "fault 900003 at 0");
  EXPECT_EQ(words_of("$IF V.L.A"), "fault 900003 at 0");
  EXPECT_EQ(words_of("L SUB"), "fault 900003 at 0");
  EXPECT_EQ(words_of("/2 X1"), "/2 X1");
}

TEST(Expressions, NameWhatTheyDoNotKnow) {
  const auto fault_of = [](std::string_view text) {
    double value = 0;
    std::size_t length = 0;
    const auto fault = read_expression(text, value, length);
    if (!fault) return std::to_string(value);
    return std::to_string(static_cast<int>(fault->code)) + " at " + std::to_string(fault->begin) +
           ": " + fault->detail;
  };
  EXPECT_EQ(fault_of("[2-1]"), "1.000000");
  EXPECT_EQ(fault_of("[2>1]"), "900003 at 2: >, a comparison");
  EXPECT_EQ(fault_of("[5 MOD 3]"), "900003 at 3: MOD, an operator");
  EXPECT_EQ(fault_of("SQRT[4]"), "900003 at 0: SQRT, a variable or function");
  EXPECT_EQ(fault_of("[2-1"), "900009 at 0: [");
}

TEST(Words, BytesThatAreNoTextAreFoundAlsoInComments) {
  using namespace std::string_view_literals;
  EXPECT_EQ(words_of("X1\0"sv), "X1 fault 900007 at 2");
  EXPECT_EQ(words_of("X1 (a\x01)"), "X1 fault 900007 at 5");
  EXPECT_EQ(words_of("; \xC3"), "fault 900007 at 2");
  EXPECT_EQ(words_of("; \xC3\xA4"), "; \xC3\xA4");
  EXPECT_EQ(words_of("X1 \xC3\xA4"), "X1 fault 900001 at 3");
}

TEST(Utf8, AcceptsWhatTheStandardAcceptsAndNothingElse) {
  const auto good = [](std::string_view text) {
    return first_byte_that_is_no_text(text) == std::string_view::npos;
  };
  EXPECT_TRUE(good("\xC2\x80 \xE0\xA0\x80 \xED\x9F\xBF \xF0\x90\x80\x80 \xF4\x8F\xBF\xBF"));
  for (const char* bad : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80",
                          "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xE2\x82"})
    EXPECT_FALSE(good(bad)) << bad;
}

TEST(Continuation, IsABackslashAtTheEndOutsideComments) {
  EXPECT_TRUE(is_continued("G01 X10 \\"));
  EXPECT_TRUE(is_continued("G01 (a) X10 \\ \t"));
  EXPECT_TRUE(is_continued("\\"));
  EXPECT_FALSE(is_continued("G01 X10"));
  EXPECT_FALSE(is_continued("G01 ; C:\\"));
  EXPECT_FALSE(is_continued("G01 (open \\"));
  EXPECT_FALSE(is_continued("%name\\"));
  EXPECT_FALSE(is_continued(""));
}

TEST(Numbers, AreRoundedAsTheStandardLibraryRoundsThem) {
  constexpr unsigned seed = 20240;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> digit('0', '9');
  std::uniform_int_distribution<std::size_t> length(0, 24);
  for (int i = 0; i < 200'000; ++i) {
    std::string text(length(random), ' ');
    for (char& byte : text) byte = static_cast<char>(digit(random));
    text.insert(text.begin() + static_cast<std::ptrdiff_t>(length(random) % (text.size() + 1)),
                '.');
    if (text.size() == 1) text += '5';
    double expected = -1;
    std::from_chars(text.data(), text.data() + text.size(), expected, std::chars_format::fixed);
    double value = 0;
    bool whole = true;
    ASSERT_EQ(read_number(text, value, whole), text.size()) << text;
    ASSERT_EQ(value, expected) << text;
    ASSERT_FALSE(whole);
  }
}

// Digits are read eight bytes at a time: whatever stands around them must not matter.
TEST(Numbers, EndWithTheFirstByteThatIsNoDigit) {
  constexpr unsigned seed = 20241;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t count) { return random() % count; };
  const int numbers = support::is_long_run() ? 5'000'000 : 100'000;
  for (int i = 0; i < numbers; ++i) {
    std::string number;
    for (std::size_t digits = below(11); digits > 0; --digits)
      number += static_cast<char>('0' + below(10));
    const bool has_point = below(3) > 0;
    if (has_point) number += '.';
    for (std::size_t digits = has_point ? below(11) : 0; digits > 0; --digits)
      number += static_cast<char>('0' + below(10));
    if (number.empty()) number = "7";
    const bool is_number = number != ".";

    std::string behind;
    for (std::size_t bytes = below(12); bytes > 0; --bytes) behind += static_cast<char>(below(256));
    const auto goes_on = [&](char byte) {
      return (byte >= '0' && byte <= '9') || (byte == '.' && !has_point);
    };
    while (!behind.empty() && goes_on(behind.front())) behind.erase(0, 1);

    const std::string text = number + behind;
    double value = -1;
    bool whole = false;
    ASSERT_EQ(read_number(text, value, whole), is_number ? number.size() : 0) << text;
    if (!is_number) continue;
    double expected = 0;
    std::from_chars(number.data(), number.data() + number.size(), expected,
                    std::chars_format::fixed);
    ASSERT_EQ(value, expected) << text;
    ASSERT_EQ(whole, !has_point) << text;
  }
}

}  // namespace
}  // namespace trc
