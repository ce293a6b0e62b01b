#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/programs/computing.h"

// Labels of Klartext: how much work their calls make, and what stays in force behind them.

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
