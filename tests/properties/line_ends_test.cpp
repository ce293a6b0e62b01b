// A program means the same however its text is written and comes: with every line end, with and
// without the last one, with and without a byte order mark, as a whole and in pieces.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "tests/support/program_run.h"
#include "tests/support/random.h"

namespace trc::support {
namespace {

constexpr std::uint64_t programs = 300;
constexpr std::string_view mark = "\xEF\xBB\xBF";

// Lines that programs of a dialect are put together from; empty: none.
struct Parts {
  DialectName dialect = DialectName::isg;
  std::vector<std::string> heads{};
  std::vector<std::string> settings{};  // before the contour; all but the first compute
  std::string contour{};
  std::vector<std::string> ends{};
  std::vector<std::string> behind{};
};

std::vector<Parts> all_parts() {
  return {
      {.dialect = DialectName::isg,
       .heads = {"", "%P1\n", "%L UP1\nN10 G91 G1 X1 F100\nN20 M17\n%P1\n", "; text\n"},
       .settings = {"", "P1=5\n", "$IF 1 > 0\nG4 X1\n$ENDIF\n", "L UP9\n", "V.P.A = 3\n"},
       .contour = "G90 G17 G0 X-20 Y-20\nV.G.WZ_AKT.R=3\nG41 G1 X0 Y-10 F500\nY40\nX60\nY0\n"
                  "G40 X80\nG0 Z50\n",
       .ends = {"", "M30\n", "P1=6\n", "X[5+1]\n"},
       .behind = {"", "G0 Z9\n", "%L UP2\nX1\nM17\n"}},
      {.dialect = DialectName::fanuc,
       .heads = {"", "%\n", "O1\n", "%\nO1 (PART)\n", "(PART)\n\nO1\n",
                 "%\nO7\nG91 G1 X1. F50\nM99\n", "O7\nG91 Z1.\nM99\nO1\n"},
       .settings = {"", "#1=60.\n", "M98 P7\n", "GOTO 5\nN5 M8\n", "IF [1 EQ 1] GOTO 5\nN5\n",
                    "#500=5.\n", "G65 P7 A1.\n"},
       .contour = "G90 G17 G0 X-20. Y-20.\nG41 D1 G1 X0 Y-10. F500\nY40.\nX60.\nY0.\nG40 X80.\n"
                  "G0 Z50.\n",
       .ends = {"", "M30\n", "T1\n", "M99\n", "#1=5\n", "M98 P7\n", "T1\nM30\n"},
       .behind = {"", "%\n", "O7\nG91 G1 X1. F50\nM99\n", "O7\nM99\n%\n", "M98 P1\n"}},
      {.dialect = DialectName::linuxcnc,
       .heads = {"", "%\n", "(part)\n", "o100 sub\nG91 G1 X1 F50\nG90\no100 endsub\n"},
       .settings = {"", "#1=5\n", "o101 if [1 EQ 1]\nM8\no101 endif\n", "o100 call\n"},
       .contour = "G90 G17 G0 X-20 Y-20\nG41.1 D6 G1 X0 Y-10 F500\nY40\nX60\nY0\nG40 X80\nG0 Z50\n",
       .ends = {"", "M2\n", "#1=6\n", "G0 X[1+2]\n"},
       .behind = {"", "%\n"}},
      {.dialect = DialectName::sinumerik,
       .heads = {"", "%_N_A_MPF\n", "; text\n", "%_N_B_SPF\nG91 G1 X1 F50\nM17\n"},
       .settings = {"", "R1=5\n", "GOTOF L1\nL1: M8\n", "DEF REAL A=5\n", "B\n"},
       .contour = "G90 G17 G0 X-20 Y-20\nG41 G1 X0 Y-10 F500\nY40\nX60\nY0\nG40 X80\nG0 Z50\n",
       .ends = {"", "M30\n", "R1=6\n", "X=R1\n"},
       .behind = {"", "%_N_B_SPF\nG91 G1 X1 F50\nM17\n", "%_N_A_MPF\nM30\n"}},
      {.dialect = DialectName::heidenhain,
       .heads = {"BEGIN PGM A MM\n", "BEGIN PGM A INCH\n"},
       .settings = {"", "Q1 = 5\n", "CALL LBL 1\n", "FN 9: IF +1 EQU +1 GOTO LBL 2\nLBL 2\n"},
       .contour = "L X-20 Y-20 R0 FMAX\nL X+0 Y-10 RL F500\nL Y+40\nL X+60\nL Y+0\n"
                  "L X+80 R0\nL Z+50 R0 FMAX\n",
       .ends = {"M30\n", "L M2\n", ""},
       .behind = {"LBL 1\nL IX+1\nLBL 0\nEND PGM A MM\n", "END PGM A MM\n", ""}}};
}

struct Program {
  std::string text{};  // with line feeds
  bool comes_out_as_it_is = false;
};

Program program_of(const Parts& parts, Random& random) {
  const auto one_of = [&](const std::vector<std::string>& texts) {
    return texts.at(random.below(texts.size()));
  };
  const bool is_plain = random.chance(0.3);
  if (is_plain)
    return {.text = parts.heads.front() + parts.contour.substr(0, parts.contour.find('\n') + 1) +
                    parts.ends.front() + parts.behind.front(),
            .comes_out_as_it_is = true};
  const std::string contour = random.chance(0.8) ? parts.contour : "";
  const std::string first = one_of(parts.heads) + one_of(parts.settings);
  return {.text = first + contour + one_of(parts.ends) + one_of(parts.behind)};
}

struct Spelling {
  std::string_view line_end{};
  bool ends_last_line = true;
  bool has_mark = false;
};

std::string spell(const std::string& text, const Spelling& spelling) {
  std::string spelt(spelling.has_mark ? mark : "");
  for (const char sign : text) {
    if (sign == '\n')
      spelt += spelling.line_end;
    else
      spelt += sign;
  }
  if (!spelling.ends_last_line && !text.empty())
    spelt.resize(spelt.size() - spelling.line_end.size());
  return spelt;
}

// With line feeds, without the mark and the last line end.
std::string normal(std::string text) {
  if (text.starts_with(mark)) text.erase(0, mark.size());
  for (std::size_t at = 0; (at = text.find("\r\n", at)) != std::string::npos;) text.erase(at, 1);
  for (char& sign : text)
    if (sign == '\r') sign = '\n';
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

ProgramSessionSetup setup_for(DialectName name) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = name;
  dialect_of(name).begin(setup.session.program.mode);
  setup.session.program.mode.tool_radius = 3;
  return setup;
}

void expect_same(const Parts& parts, const Program& program, const Spelling& spelling,
                 std::size_t piece) {
  const ProgramSessionSetup setup = setup_for(parts.dialect);
  const std::string text = spell(program.text, spelling);
  const ProgramRun plain = to_text(program.text, setup, 0, German::as_it_is);
  const ProgramRun ran = to_text(text, setup, piece, German::as_it_is);
  ASSERT_EQ(ran.report(), plain.report());
  // Of a refused program nothing is used.
  if (plain.stopped) return;
  ASSERT_EQ(normal(ran.text), normal(plain.text));
  if (program.comes_out_as_it_is) {
    ASSERT_EQ(ran.text, text);
  }
  ASSERT_EQ(to_blocks(text, setup, piece, German::as_it_is).listing(),
            to_blocks(program.text, setup, 0, German::as_it_is).listing());
}

TEST(EveryProgram, MeansTheSameWithEveryLineEnd) {
  for (const Parts& parts : all_parts())
    for (std::uint64_t seed = 1; seed <= programs; ++seed) {
      Random random(seed);
      const Program program = program_of(parts, random);
      if (program.text.empty()) continue;
      for (const std::string_view line_end : {"\n", "\r\n", "\r"})
        for (const bool ends_last_line : {true, false})
          for (const bool has_mark : {false, true})
            for (const std::size_t piece : std::array<std::size_t, 3>{0, 1, 2 + random.below(30)}) {
              SCOPED_TRACE(std::string(dialect_of(parts.dialect).spelling) + ", seed " +
                           std::to_string(seed) + ", pieces of " + std::to_string(piece) +
                           (has_mark ? ", mark" : "") + (ends_last_line ? "" : ", open end") +
                           (line_end == "\r" ? ", CR\n" : ", LF\n") + program.text);
              expect_same(
                  parts, program,
                  {.line_end = line_end, .ends_last_line = ends_last_line, .has_mark = has_mark},
                  piece);
              if (::testing::Test::HasFatalFailure()) return;
            }
    }
}

}  // namespace
}  // namespace trc::support
