#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/nc/dialect/reading.h"
#include "tests/nc/dialect/same_reading.h"
#include "tests/support/long_run.h"
#include "tests/support/random.h"

// Blocks of Klartext that hold a line, an arc or a pole alone are read in one pass. A comment
// after such a block sends it to the general reader: both readers must make the same of it.

namespace trc::testing {
namespace {

class BlockMaker {
 public:
  explicit BlockMaker(std::uint64_t seed) : random_(seed) {}

  std::string block(int number) {
    static constexpr std::array statements{"L",  "L",  "L",  "L",  "L",   "C",  "CR",
                                           "CC", "CT", "LP", "CP", "RND", "CHF"};
    const std::string statement = statements.at(random_.below(statements.size()));
    std::vector<std::string> words;
    for (const char axis : {'X', 'Y', 'Z'})
      if (random_.chance(axis == 'Z' ? 0.1 : 0.8))
        words.push_back((random_.chance(0.1) ? "I" : "") + std::string(1, axis) + value());
    const bool arc = statement == "C" || statement == "CR" || statement == "CP";
    if (random_.chance(arc ? 0.9 : 0.02)) words.emplace_back(half() ? "DR+" : "DR-");
    if (random_.chance(statement == "CR" || statement == "RND" ? 0.9 : 0.02))
      words.push_back("R" + value());
    if (random_.chance(0.15)) words.push_back(one_of({"R0", "R0", "RL", "RR", "R", "R+0"}));
    if (random_.chance(0.2))
      words.push_back(
          one_of({"F500", "F500", "F1", "FMAX", "FMAX", "F MAX", "F0", "F AUTO", "F+20.5"}));
    if (random_.chance(0.02)) words.push_back(one_of({"M3", "M99", "M91", "M136", "M2", "A+5"}));
    if (random_.chance(0.1))
      for (std::size_t i = words.size(); i > 1; --i)
        std::swap(words[i - 1], words[random_.below(i)]);
    std::string text = half() ? std::to_string(number) + " " : "";
    text += statement;
    for (const std::string& word : words) text += (random_.chance(0.99) ? " " : "") + word;
    if (random_.chance(0.05)) garble(text);
    return text;
  }

 private:
  bool half() { return random_.chance(0.5); }
  std::string one_of(std::initializer_list<const char*> texts) {
    return *(texts.begin() + random_.below(texts.size()));
  }
  std::string value() {
    static constexpr std::array rare{"0", "-0", "+3.", ".5", "-.", "", "00012.50", "1,5", "+ 2"};
    if (random_.chance(0.05)) return rare.at(random_.below(rare.size()));
    std::array<char, 60> text{};
    const auto decimals = static_cast<int>(random_.below(random_.chance(0.1) ? 20 : 5));
    std::snprintf(text.data(), text.size(), half() ? "%+.*f" : "%.*f", decimals,
                  random_.between(-50, 50));
    return text.data();
  }
  void garble(std::string& text) {
    static constexpr std::string_view signs = "XYILCRFDMZ=.-+ \t~/*\"Q1\xc3\x01l";
    const std::size_t at = random_.below(text.size());
    const std::string sign(1, signs[random_.below(signs.size())]);
    if (half()) {
      text.replace(at, 1, sign);
    } else {
      text.insert(at, sign);
    }
  }

  support::Random random_;
};

// Whether the reader of plain blocks may take it. In other blocks a comment may count.
bool may_be_plain(std::string_view block) {
  if (block.find('~') != std::string_view::npos) return false;
  block.remove_prefix(std::min(block.find_first_not_of("0123456789 "), block.size()));
  const std::string_view name = block.substr(0, block.find(' '));
  return name == "L" || name == "C" || name == "CR" || name == "CC";
}

TEST(PlainKlartext, IsReadAsTheGeneralReaderReadsIt) {
  constexpr std::array heads{"",
                             "L X+0 Y+0 R0 FMAX\n",
                             "L X+0 Y+0 Z+5 R0 FMAX\nCC X+5 Y+5\nL X+1 Y+1 RL F100\n",
                             "L X+0 Y+0 R0 FMAX M136\n",
                             "CYCL DEF 7.0\nCYCL DEF 7.1 X+5\nL X+0 Y+0\n",
                             "FN 0: Q1 = +5\nL X+0 Y+0 RR F50\nL X+20 Y+0\n"};
  ProgramSetup setup;
  setup.dialect = DialectName::heidenhain;
  const std::uint64_t programs = support::is_long_run() ? 1'000'000 : 20'000;
  std::uint64_t motions = 0;
  for (std::uint64_t seed = 1; seed <= programs && !HasFailure(); ++seed) {
    BlockMaker maker(seed);
    std::string plain_text = heads.at(seed % heads.size());
    std::string general_text = plain_text;
    for (int number = 0; number < 5; ++number) {
      const std::string block = maker.block(number);
      plain_text += block + "\n";
      general_text += block + (may_be_plain(block) ? " ;c\n" : "\n");
    }
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + plain_text);
    expect_same_reading(plain_text, general_text, setup);
    motions += read(plain_text, setup).motions().size();
  }
  EXPECT_GT(2 * motions, programs) << "the blocks try what they are for";
}

TEST(PlainKlartext, HasOneFeed) {
  for (const std::string words : {"FMAX F300", "F300 FMAX", "F MAX F300", "F300 F400"}) {
    ProgramSetup setup;
    setup.dialect = DialectName::heidenhain;
    const Reading known = read("L X+1 Y+2 R0 " + words + "\n", setup);
    ASSERT_FALSE(known.diagnostics.empty()) << words;
    EXPECT_EQ(known.diagnostics.back().code, Code::nc_word_twice) << words;
  }
}

}  // namespace
}  // namespace trc::testing
