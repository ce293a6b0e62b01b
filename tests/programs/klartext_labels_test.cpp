#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/programs/computing.h"
#include "tests/support/random.h"

// Labels of Klartext: how much work their calls make, and what stays in force after them.

namespace trc::support::klartext_labels {
namespace {

constexpr DialectName heidenhain = DialectName::heidenhain;
constexpr int too_many_lines = 900301;
constexpr int too_deep = 900302;

std::string program_of(const std::string& text) {
  return "BEGIN PGM A MM\nTOOL CALL 5 Z S5000\n" + text + "END PGM A MM\n";
}

int code_of(const std::string& text) {
  ProgramSessionSetup setup = computing_setup(heidenhain, 5);
  setup.session.program.max_executed_lines = 10'000;
  return refusal_of(program_of(text), setup).first;
}

const std::string start = "L X-20 Y-20 R0 FMAX\n";
const std::string contour = start + "L X+0 Y-10 RL F200\nL Y+40\nL X-20 R0\n";

std::string section(const std::string& name, const std::string& lines) {
  return "LBL " + name + "\n" + lines + "LBL 0\n";
}

// Labels from 1 on, each of which calls the next one twice.
std::string doubling(int labels, const std::string& innermost) {
  std::string text;
  for (int label = 1; label < labels; ++label) {
    const std::string call = "CALL LBL " + std::to_string(label + 1) + "\n";
    text += section(std::to_string(label), call + call);
  }
  return text + section(std::to_string(labels), innermost);
}

TEST(KlartextLabels, ThatCallThemselvesComeOutAsTheyStand) {
  const std::string calls = "L X+5 R0 FMAX\nCALL LBL 1\nCALL LBL 1\n";
  const std::string program = program_of("M30\n" + section("1", calls));
  EXPECT_EQ(to_text(program, computing_setup(heidenhain, 5)).text, program);
  EXPECT_EQ(code_of(contour + "CALL LBL 1\nM30\n" + section("1", calls)), 0);
  EXPECT_EQ(code_of(contour + "CALL LBL 1\nM30\n" + doubling(60, "L X+5 R0 FMAX\n")), 0);
}

TEST(KlartextLabels, WithAContourAreCalledToALimit) {
  const std::string behind_end = "CALL LBL 1\nM30\n";
  EXPECT_EQ(code_of(behind_end + section("1", contour + "CALL LBL 1\nCALL LBL 1\n")), too_deep);
  EXPECT_EQ(code_of(behind_end + doubling(25, contour)), too_many_lines);
  EXPECT_EQ(code_of(behind_end + doubling(60, contour)), too_deep);
  EXPECT_EQ(code_of(behind_end + doubling(3, contour)), 0);
}

TEST(KlartextLabels, RepeatedWithoutALineBetweenCountAsLines) {
  const std::string called = "CALL LBL 2\nM30\n" + section("2", contour);
  EXPECT_EQ(code_of("LBL 1\nCALL LBL 1 REP 4000000000\n" + called), too_many_lines);
  EXPECT_EQ(code_of("LBL 1\nCALL LBL 1 REP 5\n" + called), 0);
}

struct Mode {
  std::string sets{};
  std::string ends{};
};

const Mode modes[] = {
    {"CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2.5\n",
     "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1\n"},
    {"CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X 0.9 Y 0.8\n",
     "CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X 1 Y 1\n"},
    {"TRANS SCALE 0.9\n", "TRANS SCALE RESET\n"},
    {"FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n", "FUNCTION RESET TCPM\n"},
    {"L M128\n", "L M129\n"},
    {"L M144\n", "L M145\n"},
    {"FUNCTION CORRDATA TCS #2\n", "FUNCTION CORRDATA RESET\n"},
};

// Both where the label stands before the call and where it stands after the end.
std::pair<int, int> codes_of(const std::string& lines, const std::string& main) {
  return {code_of(section("7", lines) + "TOOL CALL 5 Z\n" + main),
          code_of(main + "M30\n" + section("7", lines))};
}

std::pair<int, int> both(int code) { return {code, code}; }

// What a label that stays in the program does counts as if its lines stood there (D-160).
TEST(KlartextLabels, ScalingAndTheLedTipHoldAfterTheCall) {
  for (const Mode& mode : modes) {
    EXPECT_EQ(codes_of(mode.sets, "L M129\nCALL LBL 7\n" + contour), both(900003)) << mode.sets;
    EXPECT_EQ(codes_of(mode.sets + mode.ends, "CALL LBL 7\n" + contour), both(0)) << mode.sets;
    EXPECT_EQ(codes_of(mode.ends, mode.sets + "CALL LBL 7\n" + contour), both(0)) << mode.sets;
    const std::string ended_in_front = "CALL LBL 7\n" + mode.ends + contour;
    EXPECT_EQ(codes_of(mode.sets, ended_in_front), both(0)) << mode.sets;
    EXPECT_EQ(code_of(contour + "CALL LBL 7\nM30\n" + section("7", mode.sets)), 0) << mode.sets;
  }
  EXPECT_EQ(codes_of("FN 17: SYSWRITE ID50 NR2 IDX1 = +6\n", "CALL LBL 7\n" + contour),
            both(900003));
}

// Every motion after M89 drills, and ends where only the control knows.
TEST(KlartextLabels, ACycleOfACalledLabelRunsAfterItsCall) {
  EXPECT_EQ(code_of("CALL LBL 7\n" + contour + "M30\n" + section("7", "L M89\n")), 900106);
  EXPECT_EQ(code_of("CALL LBL 7\n" + contour + "M30\n" + section("7", "L M89\nL M99\n")), 0);
}

TEST(KlartextLabels, ModesOfWhatALabelCallsHoldToo) {
  const std::string main = "CALL LBL 7\n" + contour + "M30\n";
  const std::string inner = section("8", modes[0].sets);
  const std::string outer = section("7", "CALL LBL 8\n");
  EXPECT_EQ(code_of(main + outer + inner), 900003);
  EXPECT_EQ(code_of(main + inner + outer), 900003);
  EXPECT_EQ(code_of(main + inner + section("7", "CALL LBL 8\n" + modes[0].ends)), 0);
  EXPECT_EQ(code_of(main + section("7", "CALL LBL 7\n")), 900003);  // no end of it
  EXPECT_EQ(code_of("CALL LBL Q5\n" + contour + "M30\n" + inner), 900003);
  EXPECT_EQ(code_of("CALL LBL Q5\n" + contour + "M30\n" + section("7", "L X+5 R0 FMAX\n")), 0);
}

// A jump may lead past what ends a mode, not past what never begins one.
TEST(KlartextLabels, WhatAJumpMayLeaveOutIsNotCountedOn) {
  const std::string jump = "FN 9: IF +Q1 EQU +0 GOTO LBL 8\n";
  const std::string main = "CALL LBL 7\n" + contour + "M30\n";
  const auto section_of = [&](const std::string& lines) {
    return section("7", modes[0].sets + jump + lines + "LBL 8\n");
  };
  EXPECT_EQ(code_of(main + section_of(modes[0].ends)), 900003);
  EXPECT_EQ(code_of(main + section("7", jump + "L X+Q1 R0 FMAX M99\nLBL 8\n")), 0);
  EXPECT_EQ(code_of(main + section("7", jump) + section("8", "L Z+5 R0 FMAX\n")), 0);
  EXPECT_EQ(code_of(main + section("7", jump) + section("8", modes[0].sets)), 900003);
}

TEST(KlartextLabels, AFeedAtTheContourHoldsAfterTheCall) {
  const std::string arcs =
      start + "L X+0 Y-10 RL F200\nL Y+40\nCR X+20 Y+60 R+20 DR-\nL X+40\nL Y+80 R0\n";
  const auto feeds_of = [&](const std::string& main, const std::string& label) {
    const ProgramRun ran =
        to_blocks(program_of(main + arcs + "M30\n" + label), computing_setup(heidenhain, 5));
    EXPECT_FALSE(ran.stopped) << ran.report();
    std::vector<double> feeds;
    for (const CompensatedBlock& block : ran.blocks)
      if (block.feed > 0) feeds.push_back(block.feed);
    return feeds;
  };
  EXPECT_EQ(feeds_of("CALL LBL 7\n", section("7", "L M109\n")), feeds_of("L M109\n", ""));
  EXPECT_EQ(feeds_of("L M109\nCALL LBL 7\n", section("7", "L M111\n")), feeds_of("", ""));
  EXPECT_NE(feeds_of("L M109\n", ""), feeds_of("", ""));
}

// Labels after the end that call one another, and what a call of the first one is as lines. A
// label calls only those that stand after it in `flat`.
struct RandomLabels {
  explicit RandomLabels(Random& random) {
    constexpr int most = 5;
    for (int label = most; label > 0; --label) {
      std::string lines;
      std::string as_lines;
      for (std::size_t left = random.below(4); left > 0; --left) {
        const int called = label + 1 + static_cast<int>(random.below(2));
        if (called <= most && random.chance(0.4)) {
          lines += "CALL LBL " + std::to_string(called) + "\n";
          as_lines += flat[called];
        } else {
          const Mode& mode = modes[random.below(std::size(modes))];
          const std::string line = random.chance(0.3) ? mode.sets : mode.ends;
          lines += line;
          as_lines += line;
        }
      }
      flat[label] = as_lines;
      const std::string text = section(std::to_string(label), lines);
      sections = random.chance(0.5) ? sections + text : text + sections;
    }
  }

  std::map<int, std::string> flat{};
  std::string sections{};
};

TEST(KlartextLabels, CountAsIfTheirLinesStoodThere) {
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RandomLabels labels(random);
    const std::string main = random.chance(0.5) ? modes[random.below(std::size(modes))].sets : "";
    const std::string program = main + "CALL LBL 1\n" + contour + "M30\n" + labels.sections;
    const int code = code_of(program);
    EXPECT_EQ(code, code_of(main + labels.flat.at(1) + contour)) << program;
    accepted += code == 0 ? 1 : 0;
  }
  EXPECT_GT(accepted, 50);
  EXPECT_LT(accepted, 250);
}

// Of a long program the lines before the first call have gone out when it is read.
TEST(KlartextLabels, FarBeforeTheirCallCountToo) {
  std::string far;
  for (int line = 0; line < 2000; ++line) far += "L X+5 Y+5 R0 FMAX ; so far in front of it\n";
  for (const Mode& mode : modes) {
    const std::string behind = far + "CALL LBL 7\n" + contour;
    EXPECT_EQ(code_of(section("7", mode.sets) + mode.ends + behind), 900003) << mode.sets;
    EXPECT_EQ(code_of(section("7", mode.sets + mode.ends) + behind), 0) << mode.sets;
  }
}

TEST(KlartextLabels, RepeatedWithinACalledOneAreWrittenOut) {  // D-82
  const std::string depths = "LBL 2\nL IZ-1 R0 F100\n" + contour + "CALL LBL 2 REP 2\n";
  const std::string text =
      program_of("CALL LBL 1\nM30\n" + section("1", "L Z+0 R0 FMAX\n" + depths));
  const ProgramRun ran = to_text(text, computing_setup(heidenhain, 5));
  ASSERT_FALSE(ran.stopped) << ran.report();
  EXPECT_NE(ran.text.find("M30\nEND PGM A MM\n"), std::string::npos) << ran.text;
}

// After the end stand labels, whatever was wrong before it.
TEST(KlartextLabels, AfterTheEndAreNotLookedThroughWithTheProgram) {
  const ProgramRun ran =
      to_text(program_of(start + "L X+0 Y-10 RL F200\nFL PR+5\nL Y+40\nL X-20 R0\nM30\n" +
                         section("1", "CYCL DEF 11.0 SCALING\nL X+Q1 R0\nCYCL CALL\n")),
              computing_setup(heidenhain, 5));
  ASSERT_TRUE(ran.stopped);
  EXPECT_EQ(ran.codes(), "900003 at line 5");
}

// Old printouts write the repetitions left after a blank.
TEST(KlartextLabels, AreRepeatedAsOftenAsRepSays) {
  const auto path = [](const std::string& rep) {
    return to_text(program_of("LBL 1\n" + contour + "CALL LBL 1 " + rep + "\nM30\n"),
                   computing_setup(heidenhain, 5))
        .text;
  };
  EXPECT_NE(path("REP 2"), "");
  EXPECT_EQ(path("REP 2/2"), path("REP 2"));
  EXPECT_EQ(path("REP 2 /2"), path("REP 2"));
}

// The control calls them, so that they are compensated by themselves (D-121).
TEST(ProgramsThatKlartextCalls, AreLookedThroughForContours) {
  const auto told = [](const std::string& call, const std::string& called) {
    ProgramSessionSetup setup = computing_setup(heidenhain, 5);
    setup.session.program.subprograms = {{"sub/KONT.H", called}};
    const ProgramRun ran = to_text(program_of(start + call + "\nM30\n"), setup);
    return ran.stopped ? ran.diagnostics.front().detail : std::string();
  };
  const std::string with_contour = "BEGIN PGM KONT MM\n1 L X+0 Y-10 RL F300\nEND PGM KONT MM\n";
  const std::string refused = "a call of KONT, whose RL and RR are not followed";
  for (const char* call : {"CALL PGM KONT", "4 CALL PGM TNC:\\PART\\kont.h ; A B",
                           "SEL PGM \"KONT\"", "CYCL DEF 12.1 PGM KONT"})
    EXPECT_EQ(told(call, with_contour), refused) << call;
  EXPECT_EQ(told("CALL PGM OTHER", with_contour), "");
  EXPECT_EQ(told("CALL PGM KONT", "BEGIN PGM KONT MM\nL X+0 R0 ; RL\nEND PGM KONT MM\n"), "");
}

// As many as a program may have: each is looked at as often as it is called.
TEST(KlartextLabels, ManyOfThemTakeTimeThatGrowsWithTheirNumber) {
  constexpr int many = 60'000;
  std::string sections;
  std::string open;
  std::string calls;
  for (int label = 1; label <= many; ++label) {
    const std::string name = std::to_string(label);
    sections += section(name, "");
    open += "LBL " + name + "\n";
    calls += "CALL LBL " + name + "\n";
  }
  EXPECT_EQ(
      refusal_of(program_of(sections + contour + calls), computing_setup(heidenhain, 5)).first, 0);
  EXPECT_EQ(refusal_of(program_of(calls + open + contour), computing_setup(heidenhain, 5)).first,
            900003);
}

TEST(KlartextLabels, ALongTextOfThemIsInterrupted) {
  ProgramSessionSetup setup = computing_setup(heidenhain, 5);
  setup.session.compensator.interrupt = [] { throw std::runtime_error("cancelled"); };
  ProgramSession session(setup);
  Answers answers;
  std::string text = "CALL LBL 1\n";
  for (int line = 0; line < 300; ++line) text += "LBL 0\n";
  EXPECT_TRUE(session.feed(program_of(text), answers));
  EXPECT_THROW(session.finish(answers), std::runtime_error);
  EXPECT_EQ(session.executed_lines(), 0u);
}

}  // namespace
}  // namespace trc::support::klartext_labels
