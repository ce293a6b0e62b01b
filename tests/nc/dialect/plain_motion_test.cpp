#include "core/nc/dialect/plain_motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/nc/dialect/reading.h"
#include "tests/nc/dialect/same_reading.h"
#include "tests/support/long_run.h"
#include "tests/support/random.h"

// Lines that hold a motion alone are read in one pass. A comment after such a line sends it to the
// general reader: both readers must make the same of it.

namespace trc::testing {
namespace {

bool is_plain(std::string_view line) {
  PlainMotion plain;
  std::vector<WordRange> words;
  return plain.read(line, words);
}

TEST(PlainMotion, IsALineOfMotionWordsInAnyOrderAndSpelling) {
  EXPECT_TRUE(is_plain("N10 G01 X1.5 Y-2"));
  EXPECT_TRUE(is_plain("x1y2g3i.5j0.f100n7"));
  EXPECT_TRUE(is_plain("\tG2 X1 R5 "));
  EXPECT_TRUE(is_plain("Z5"));
}

TEST(PlainMotion, IsNoLineWithAnythingElse) {
  for (const std::string line : {"",
                                 "  ",
                                 "N10",
                                 "G01",
                                 "F100",
                                 "G01 X1 (c)",
                                 "G01 X1 ;c",
                                 "G01 X1 M8",
                                 "G17 X1",
                                 "G41 X1",
                                 "X1 A5",
                                 "X 1",
                                 "X=1",
                                 "X1=2",
                                 "X1 X2",
                                 "G1 G1 X1",
                                 "G1.0 X1",
                                 "G4 X1",
                                 "G-1 X1",
                                 "N1.5 X1",
                                 "N-1 X1",
                                 "X1 F0",
                                 "X1 F-5",
                                 "X",
                                 "X-",
                                 "X.",
                                 "X1e5",
                                 "X1 \\",
                                 "%X1",
                                 "/X1",
                                 "#X1",
                                 "X1\r",
                                 "X1 Y\xc3\xa4",
                                 "N10000000000000000 X1"})
    EXPECT_FALSE(is_plain(line)) << line;
  EXPECT_FALSE(is_plain("X" + std::string(400, '9'))) << "no double is as large";
  EXPECT_FALSE(is_plain(std::string("X1\0", 3)));
}

class LineMaker {
 public:
  explicit LineMaker(std::uint64_t seed) : random_(seed) {}

  std::string line(int number) {
    std::vector<std::string> words;
    if (random_.chance(0.8)) words.push_back((half() ? "G0" : "G") + one_of("0123"));
    for (const char axis : {'X', 'Y', 'Z'})
      if (random_.chance(axis == 'Z' ? 0.1 : 0.8)) words.push_back(axis + value());
    for (const char center : {'I', 'J', 'K', 'R'})
      if (random_.chance(center <= 'J' ? 0.3 : 0.03)) words.push_back(center + value());
    if (random_.chance(0.2)) words.push_back("F" + std::to_string(random_.below(2000)));
    if (half()) words.insert(words.begin(), "N" + std::to_string(number));
    if (random_.chance(0.2))
      for (std::size_t i = words.size(); i > 1; --i)
        std::swap(words[i - 1], words[random_.below(i)]);
    const std::string blank = random_.chance(0.8) ? " " : "";
    std::string text;
    for (const std::string& word : words) text += word + blank;
    if (!text.empty() && random_.chance(0.1)) garble(text);
    return text;
  }

  bool half() { return random_.chance(0.5); }
  std::string one_of(std::string_view letters) {
    return std::string(1, letters[random_.below(letters.size())]);
  }

 private:
  std::string value() {
    static constexpr std::array rare{"0", "-0",       "+3.", ".5",       "-.",
                                     "",  "00012.50", "1e3", "999999999"};
    if (random_.chance(0.1)) return rare[random_.below(rare.size())];
    std::array<char, 60> text{};
    const auto decimals = static_cast<int>(random_.below(random_.chance(0.1) ? 20 : 7));
    std::snprintf(text.data(), text.size(), "%.*f", decimals, random_.between(-500, 500));
    return text.data();
  }

  void garble(std::string& text) {
    const std::size_t at = random_.below(text.size());
    const std::string sign = one_of("XYGNIJ=.-+ \t)#$/%\"A1\xc3\x01\xe4");
    if (half()) {
      text.replace(at, 1, sign);
    } else {
      text.insert(at, sign);
    }
  }

  support::Random random_;
};

TEST(PlainMotion, IsReadAsTheGeneralReaderReadsIt) {
  constexpr std::array heads{"",
                             "G70\n",
                             "G91\n",
                             "G161\n",
                             "G95 F1\n",
                             "G54\n",
                             "V.G.WZ_AKT.R=1\nG01 F100 X0\nG41 X10\n"};
  const std::uint64_t programs = support::is_long_run() ? 1'000'000 : 20'000;
  std::uint64_t plain_lines = 0;
  for (std::uint64_t seed = 1; seed <= programs && !HasFailure(); ++seed) {
    LineMaker maker(seed);
    std::string plain_text = heads[seed % heads.size()];
    std::string general_text = plain_text;
    for (int number = 0; number < 5; ++number) {
      const std::string line = maker.line(number);
      plain_lines += is_plain(line) ? 1 : 0;
      plain_text += line + "\n";
      general_text += line + "(c)\n";
    }
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + plain_text);
    expect_same_reading(plain_text, general_text);
  }
  EXPECT_GT(plain_lines, 2 * programs) << "the lines try what they are for";
}

}  // namespace
}  // namespace trc::testing
