#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/programs/computing.h"

// A value within a value within a value …, in each place where one can stand: whoever reads it
// calls itself for each, and has to stop long before the stack runs out.

namespace trc::support::nested_values {
namespace {

using enum DialectName;

struct Nested {
  DialectName dialect{};
  std::string head{};
  std::vector<std::string> openings{};  // of a value before another one
  std::vector<std::string> values{};    // `@`: the value
  std::vector<std::string> others{};    // where such a value may be wrong for another reason
};

const std::vector<Nested>& all_nested() {
  static const std::vector<Nested> all{
      {.dialect = fanuc,
       .head = "G21 G90\n#1=1\n",
       .openings = {"-", "+", "#", "[", "#[", "#-", "SIN[", "ATAN[", "ATAN[1]/[", "POW[1,", "[1+["},
       .values = {"X[@", "X-[@", "#2=@", "#[@=5", "IF[@ EQ 1] GOTO 1", "WHILE[@ LT 1] DO1",
                  "GOTO[@", "M98 P[@", "G65 P1 A[@", "G41 D[@"},
       .others = {"@", "X@", "X-@", "N@", "G@", "M@", "O@", "#@=5", "IF@", "G10 L12 P@ R1", "X1,R@",
                  "/@", "END@"}},
      {.dialect = linuxcnc,
       .head = "G21 G90\n#1=1\n",
       .openings = {"-", "+", "#", "[", "#[", "#-", "SIN[", "ATAN[1]/[", "1**[", "EXISTS[#"},
       .values = {"X[@", "#2=[@", "#<a>=[@", "O1 IF[@", "O1 WHILE[@", "O1 CALL [@", "G41 D[@"},
       .others = {"@", "X@", "N@", "G@", "M@", "O@", "o<@", "#@=5", "O1 RETURN [@", "(debug,#@)",
                  "O[@", "/@"}},
      {.dialect = sinumerik,
       .head = "DEF REAL A[9]\nR1=1\n",
       .openings = {"-", "+", "R[", "(", "A[", "-R[", "NOT ", "B_NOT ", "SIN(", "ATAN2(1,",
                    "MINVAL(", "BOUND(1,2,"},
       .values = {"X=(@", "X=IC(@", "R2=@", "R[@]=5", "A[@]=5", "IF @\nENDIF", "WHILE @\nENDWHILE",
                  "FOR R1=1 TO @\nENDFOR", "REPEAT\nUNTIL @", "DEF REAL B=@"},
       .others = {"@", "X@", "X=@", "N@", "G@", "M@", "M=@", "D=@", "SUB(@", "L1 P=@", "CYCLE81(@",
                  "MSG(@)", "CASE @ OF 1 GOTOF B", "GOTOF @", "$TC_DP6[@", "TRANS X=@", "G4 F@",
                  "R1=SET(@"}},
      {.dialect = isg,
       .head = "P1=1\n#VAR\nV.P.A[9]\n#ENDVAR\n",
       .openings = {"-", "+", "P[", "[", "V.P.A[", "SIN[", "MIN[1,", "NOT[", "[1+["},
       .values = {"X[@", "P2=@", "P[@]=5", "V.P.A[@]=5", "$IF @\n$ENDIF", "$WHILE @\n$ENDWHILE",
                  "$FOR P2=1,@,1\n$ENDFOR", "$SWITCH @\n$ENDSWITCH"},
       .others = {"@", "X@", "X=@", "X=1+@", "N@", "G@", "M@", "$GOTO @", "#TRC[STRETCH_FACTOR=@",
                  "L A [@", "V.G.WZ_AKT.R=@", "#VAR\nV.P.B=@\n#ENDVAR", "P@", "PP@"}}};
  return all;
}

std::string line_with(const std::string& place, const std::string& opening) {
  constexpr std::size_t deep = 100'000;
  std::string value;
  while (value.size() < deep) value += opening;
  std::string line = place;
  return line.replace(line.find('@'), 1, value);
}

ProgramRun ran_with(const Nested& nested, const std::string& line) {
  ProgramSessionSetup setup = computing_setup(nested.dialect, 5);
  setup.longest_line = 1 << 20;
  setup.most_faults = 50;
  // The second line is one that is looked at after the first error.
  return to_text(nested.head + line + "\n" + line + "\nM30\n", setup, 0, German::as_it_is);
}

TEST(NestedValues, AreRefusedWhereAValueIsRead) {
  for (const Nested& nested : all_nested())
    for (const std::string& place : nested.values)
      for (const std::string& opening : nested.openings) {
        const ProgramRun ran = ran_with(nested, line_with(place, opening));
        EXPECT_TRUE(ran.stopped && std::ranges::any_of(ran.diagnostics,
                                                       [](const Diagnostic& told) {
                                                         return told.code ==
                                                                    Code::expression_invalid &&
                                                                told.detail == "nested too deeply";
                                                       }))
            << place << ' ' << opening;
      }
}

// The line is refused, or passed on as it stands, but for the value of a parameter that a message
// may begin with.
TEST(NestedValues, EndNoProcessWhereverTheyStand) {
  for (const Nested& nested : all_nested())
    for (const std::string& place : nested.others)
      for (const std::string& opening : nested.openings) {
        const std::string line = line_with(place, opening);
        const ProgramRun ran = ran_with(nested, line);
        const bool passes =
            !ran.stopped && ran.text.find(line.substr(line.size() / 2)) != std::string::npos;
        EXPECT_TRUE(passes || (ran.stopped && !ran.diagnostics.empty())) << place << ' ' << opening;
      }
}

// The number of a parameter in a parameter, which needs no more room the longer it is.
TEST(NestedValues, OfIsgMayBeHeldByAsManyParametersAsThereAre) {
  const ProgramRun ran =
      to_text("P1=1\nX" + std::string(30'000, 'P') + "1\nM30\n", computing_setup(isg, 5));
  EXPECT_EQ(ran.text, "X1\nM30\n");
}

}  // namespace
}  // namespace trc::support::nested_values
