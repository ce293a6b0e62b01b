// A program that needs no compensation comes out as it went in, byte for byte.

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <string>

#include "tests/session/random_program.h"
#include "tests/support/program_run.h"
#include "tests/support/random.h"

namespace trc::support {
namespace {

constexpr std::uint64_t spellings = 2'000;

// Spells a program as people and post-processors write it: case, blanks, signs and zeros of
// numbers, comments, line ends and the byte order mark vary.
class Speller {
 public:
  explicit Speller(std::uint64_t seed) : random_(seed) {
    lower_ = random_.chance(0.3);
    crammed_ = random_.chance(0.3);
    line_end_ = std::array{"\n", "\r\n", "\r"}[random_.below(3)];
  }

  std::string spell(const std::string& program) {
    std::string text = random_.chance(0.3) ? "\xEF\xBB\xBF" : "";
    for (std::size_t at = 0; at < program.size();) {
      const std::size_t end = std::min(program.find('\n', at), program.size());
      std::string line = program.substr(at, end - at);
      if (!line.empty() && line.back() == '\r') line.pop_back();
      text += line.starts_with('%') ? line : spell_line(line);
      if (end < program.size()) text += line_end_;
      if (end < program.size() && random_.chance(0.1)) text += extra_line() + line_end_;
      at = end + 1;
    }
    return text;
  }

 private:
  // TRC is off already: G40 ends nothing and stays.
  std::string extra_line() {
    return std::array{"G40", "N5 g40 M9",        "  G40 (off)  ",
                      "\t",  "; 50 % \xC3\xB6l", "(G41 X5 is text)",
                      "N77"}[random_.below(7)];
  }

  std::string spell_line(const std::string& line) {
    std::string text(random_.chance(0.25) ? random_.below(4) : 0, ' ');
    bool comment = false;
    for (std::size_t at = 0; at < line.size(); ++at) {
      const char c = line[at];
      const char next = at + 1 < line.size() ? line[at + 1] : ' ';
      if (comment || c == '(' || c == ';') {
        comment = c != ')';
        text += c;
      } else if (c == ' ') {
        const bool may_go = crammed_ && std::isalpha(uchar(next)) != 0;
        text += may_go ? "" : random_.chance(0.1) ? "\t" : random_.chance(0.1) ? "   " : " ";
      } else {
        text += lower_ ? static_cast<char>(std::tolower(uchar(c))) : c;
        const bool coordinate = std::string_view("XYZIJKA").find(c) != std::string_view::npos;
        if (coordinate && std::isdigit(uchar(next)) != 0)
          text += std::array{"", "", "", "+", "0", "00", "= ", " "}[random_.below(8)];
      }
    }
    if (!comment && random_.chance(0.1)) text += random_.chance(0.5) ? " (c)" : "  ; c \t";
    if (random_.chance(0.1)) text += "  ";
    return text;
  }

  static unsigned char uchar(char c) { return static_cast<unsigned char>(c); }

  support::Random random_;
  bool lower_ = false;
  bool crammed_ = false;
  std::string line_end_{};
};

TEST(ProgramWithoutCompensation, ComesOutByteForByteHoweverItIsSpelt) {
  for (std::uint64_t seed = 1; seed <= spellings; ++seed) {
    const std::string program = Speller(seed).spell(random_program(seed, false));
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ProgramRun run = to_text(program, {}, seed % 40);
    ASSERT_FALSE(run.stopped) << run.codes() << '\n' << program;
    // Random centres may be off by so much that their correction is told (D-41).
    for (const Diagnostic& reported : run.diagnostics)
      ASSERT_EQ(reported.code, Code::center_corrected) << run.codes();
    ASSERT_EQ(run.text, program);
  }
}

// The decimals of the output apply to lines that are written anew, and to no others.
TEST(ProgramWithoutCompensation, KeepsItsDigitsWithFewDecimals) {
  ProgramSessionSetup setup;
  setup.session.program.decimals = 1;
  for (std::uint64_t seed = 1; seed <= spellings / 10; ++seed) {
    const std::string program = Speller(seed).spell(random_program(seed, false));
    ASSERT_EQ(to_text(program, setup).text, program) << "seed " << seed;
  }
}

// Lines before, between and after two selections stay as they are written.
TEST(ProgramWithoutCompensation, ItsLinesStayAlsoBesideASelection) {  // D-140
  const std::string selection = "V.G.WZ_AKT.R=1\nG139 G41 G1 X10 Y0\nX50\nG40 X60 Y5\n";
  const std::string resolved = "G01 X10 Y1\nG01 X50 Y1\nG01 X60 Y5\n";
  const std::string before = "%p\nn1 g40 g17  G90\nG1 x0.0 Y+00 F0100 ; start\n";
  const std::string between = "G01 x 65.000  y5 (between)\n  M8\nG40\nG0 X0 Y0\n";
  const std::string behind = "g01X-5.50Y.25\nM30\n";
  EXPECT_EQ(to_text(before + selection + between + selection + behind).text,
            before + resolved + between + resolved + behind);
}

}  // namespace
}  // namespace trc::support
