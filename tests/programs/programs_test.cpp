#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/support/expectation.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/program_run.h"

// NC programs as tests. `good`: the path beside the program, worked out from the rules, must come
// out. `bad`: the diagnostic of the first line must.

namespace trc::support {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(testing_support::source_dir()) / "tests" / "programs";

std::string read(const fs::path& file) { return testing_support::content_of(folder / file); }

// Their names, without ".nc".
std::vector<std::string> programs_in(const char* kind) {
  std::vector<std::string> names;
  for (const fs::path& program : testing_support::nc_programs_in(kind))
    names.push_back(program.stem().string());
  return names;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& tested) {
  std::string name;
  bool upper = true;
  for (const char c : tested.param) {
    if (c != '_')
      name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = c == '_';
  }
  return name;
}

// The program with its compensation resolved.
std::string resolved_text(const std::string& text, ProgramSessionSetup setup) {
  setup.session.program.decimals = 6;
  return to_text(text, setup).text;
}

class GoodProgram : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    text_ = read(fs::path("good") / (GetParam() + ".nc"));
    setup_ = read_setup(text_);
    expected_ = read_expectation(read(fs::path("good") / (GetParam() + ".expected")));
    ASSERT_FALSE(expected_.blocks.empty());
  }

  std::string text_{};
  ProgramSessionSetup setup_{};
  Expectation expected_{};
};

TEST_P(GoodProgram, GivesItsPath) {
  const ProgramRun outcome = to_blocks(text_, setup_);
  ASSERT_FALSE(outcome.stopped) << outcome.report();
  EXPECT_EQ(difference(outcome.blocks, expected_.blocks, false), "") << text_of(outcome.blocks);
  ASSERT_EQ(outcome.diagnostics.size(), expected_.diagnostics.size()) << outcome.report();
  for (std::size_t k = 0; k < expected_.diagnostics.size(); ++k) {
    const ExpectedDiagnostic& expected = expected_.diagnostics[k];
    EXPECT_EQ(outcome.diagnostics[k].code, expected.code);
    if (expected.line) {
      EXPECT_EQ(outcome.diagnostics[k].source.line, *expected.line);
    }
  }
}

TEST_P(GoodProgram, IsConnected) { EXPECT_EQ(first_gap(to_blocks(text_, setup_).blocks), ""); }

TEST_P(GoodProgram, GivesTheSameInPieces) {
  const std::string whole = text_of(to_blocks(text_, setup_).blocks);
  for (const std::size_t piece : {1U, 2U, 7U, 64U})
    EXPECT_EQ(text_of(to_blocks(text_, setup_, piece).blocks), whole)
        << piece << " bytes at a time";
}

TEST_P(GoodProgram, ReadsBackAsTheSamePathWithoutCompensation) {
  const auto wanted = moving(to_blocks(text_, setup_).blocks, 1e-5);
  const std::string resolved = resolved_text(text_, setup_);
  const ProgramRun again = to_blocks(resolved, setup_);
  ASSERT_FALSE(again.stopped) << again.report() << resolved;
  const auto path = moving(again.blocks, 1e-5);
  ASSERT_EQ(path.size(), wanted.size()) << resolved;
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_EQ(path[k].origin, Origin::uncompensated);
    // A control with three decimals would make a full circle of an arc as short as that (D-97).
    constexpr double shortest_arc = 1.5e-3;
    const bool is_long = (end_of(path[k].path) - start_of(path[k].path)).norm() >= shortest_arc;
    ASSERT_TRUE(!is_long || is_arc(path[k].path) == is_arc(wanted[k].path)) << resolved;
    for (const double t : {0.0, 0.5, 1.0})
      EXPECT_LT((point_at(path[k].path, t) - point_at(wanted[k].path, t)).norm(), 1e-5)
          << text_of(wanted[k]) << '\n'
          << resolved;
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, GoodProgram, ::testing::ValuesIn(programs_in("good")),
                         test_name);

class BadProgram : public ::testing::TestWithParam<std::string> {};

TEST_P(BadProgram, RaisesTheDiagnosticOfItsFirstLine) {
  const std::string text = read(fs::path("bad") / (GetParam() + ".nc"));
  const ExpectedDiagnostic expected = read_expected_refusal(text);
  const ProgramRun outcome = to_blocks(text, read_setup(text));
  const auto raised =
      std::find_if(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                   [&](const Diagnostic& diagnostic) { return diagnostic.code == expected.code; });
  ASSERT_NE(raised, outcome.diagnostics.end())
      << "expected " << static_cast<int>(expected.code) << ", got\n"
      << outcome.report() << text_of(outcome.blocks);
  if (expected.line) {
    EXPECT_EQ(raised->source.line, *expected.line);
  }
  EXPECT_EQ(outcome.stopped, raised->severity == Severity::error) << outcome.report();
  EXPECT_EQ(first_gap(outcome.blocks), "");
  for (const std::size_t piece : {1U, 5U}) {
    const ProgramRun pieces = to_blocks(text, read_setup(text), piece);
    EXPECT_EQ(pieces.report(), outcome.report());
    EXPECT_EQ(text_of(pieces.blocks), text_of(outcome.blocks));
  }
  const fs::path beginning = folder / "bad" / (GetParam() + ".expected");
  if (fs::exists(beginning)) {
    EXPECT_EQ(difference(outcome.blocks,
                         read_expectation(testing_support::content_of(beginning)).blocks, true),
              "");
  }
}

// Every row of the table of codes has a program that raises it.
TEST(Codes, AreEachRaisedByAProgram) {
  std::set<Code> raised;
  for (const std::string& name : programs_in("bad"))
    raised.insert(read_expected_refusal(read(fs::path("bad") / (name + ".nc"))).code);
  for (const std::string& name : programs_in("good"))
    for (const ExpectedDiagnostic& expected :
         read_expectation(read(fs::path("good") / (name + ".expected"))).diagnostics)
      raised.insert(expected.code);
  // It takes more than 16 MiB of text: computing_test.cpp raises it.
  raised.insert(Code::computing_text_too_long);
  // They are of calls, tool tables and variables of other dialects: tools_of_programs_test.cpp and
  // kept_variables_test.cpp raise them.
  raised.insert({Code::tool_radius_contradicts, Code::tool_may_have_changed,
                 Code::machine_compensates, Code::given_value_kept});
  // It is of NC text that comes out: nc_output_test.cpp raises it.
  raised.insert(Code::line_beyond_control);
  for (const CodeRow& row : code_table())
    EXPECT_TRUE(raised.contains(row.code)) << static_cast<int>(row.code) << ' ' << row.reason;
}

INSTANTIATE_TEST_SUITE_P(Programs, BadProgram, ::testing::ValuesIn(programs_in("bad")), test_name);

}  // namespace
}  // namespace trc::support
