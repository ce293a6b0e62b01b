#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/english_words.h"
#include "tests/support/expectation.h"
#include "tests/support/places.h"
#include "tests/support/run.h"

// NC programs as tests. `good`: the path beside the program, worked out from the
// rules, must come out, or, where `manifest.txt` says that a function is not
// there yet, the clear refusal. `bad`: the diagnostic of the first line must.

namespace trc::support {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(testing_support::source_dir()) / "tests" / "programs";

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> programs_in(const char* kind) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / kind))
    if (entry.path().extension() == ".nc") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// Program name -> "passes" or "not_available".
std::map<std::string, std::string> read_manifest() {
  std::map<std::string, std::string> manifest;
  std::istringstream stream(read_file(folder / "manifest.txt"));
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name;
    std::string state;
    words >> name >> state;
    manifest[name] = state;
  }
  return manifest;
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

// Feeds the text in pieces of `piece` bytes.
Outcome run(const std::string& text, ProgramSessionSetup setup, std::size_t piece) {
  setup.nc_text = false;
  ProgramSession session(setup);
  Answers answers;
  bool running = true;
  for (std::size_t at = 0; running && at < text.size(); at += piece)
    running = session.feed(std::string_view(text).substr(at, piece), answers);
  if (running) session.finish(answers);
  Answer output = answers.take();
  return {.blocks = std::move(output.blocks),
          .diagnostics = std::move(output.diagnostics),
          .stopped = session.diagnostics().stopped()};
}

std::string resolved_text(const std::string& text, ProgramSessionSetup setup) {
  setup.nc_text = true;
  setup.session.program.decimals = 6;
  ProgramSession session(setup);
  Answers answers;
  if (session.feed(text, answers)) session.finish(answers);
  return answers.take().text;
}

std::string report_of(const std::vector<Diagnostic>& diagnostics) {
  std::ostringstream text;
  for (const Diagnostic& diagnostic : diagnostics)
    text << static_cast<int>(diagnostic.code) << " at line " << diagnostic.source.line << ": "
         << message_of(diagnostic) << '\n';
  return text.str();
}

class GoodProgram : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const auto manifest = read_manifest();
    const auto row = manifest.find(GetParam());
    ASSERT_NE(row, manifest.end()) << GetParam() << " is not in manifest.txt";
    ASSERT_TRUE(row->second == "passes" || row->second == "not_available") << row->second;
    built_ = row->second == "passes";
    text_ = read_file(folder / "good" / (GetParam() + ".nc"));
    setup_ = read_setup(text_);
    expected_ = read_expectation(read_file(folder / "good" / (GetParam() + ".expected")));
    ASSERT_FALSE(expected_.blocks.empty());
  }

  bool built_ = true;
  std::string text_{};
  ProgramSessionSetup setup_{};
  Expectation expected_{};
};

TEST_P(GoodProgram, GivesItsPath) {
  const Outcome outcome = run(text_, setup_, text_.size());
  if (!built_) {
    ASSERT_TRUE(outcome.stopped) << "built by now: move it to `passes`";
    EXPECT_EQ(outcome.error()->code, Code::not_available) << report_of(outcome.diagnostics);
    EXPECT_EQ(difference(outcome.blocks, expected_.blocks, true), "");
    return;
  }
  ASSERT_FALSE(outcome.stopped) << report_of(outcome.diagnostics);
  EXPECT_EQ(difference(outcome.blocks, expected_.blocks, false), "") << text_of(outcome.blocks);
  ASSERT_EQ(outcome.diagnostics.size(), expected_.diagnostics.size())
      << report_of(outcome.diagnostics);
  for (std::size_t k = 0; k < expected_.diagnostics.size(); ++k) {
    const ExpectedDiagnostic& expected = expected_.diagnostics[k];
    EXPECT_EQ(outcome.diagnostics[k].code, expected.code);
    if (expected.line) {
      EXPECT_EQ(outcome.diagnostics[k].source.line, *expected.line);
    }
  }
}

TEST_P(GoodProgram, IsConnected) {
  EXPECT_EQ(first_gap(run(text_, setup_, text_.size()).blocks), "");
}

TEST_P(GoodProgram, GivesTheSameInPieces) {
  const std::string whole = text_of(run(text_, setup_, text_.size()).blocks);
  for (const std::size_t piece : {1U, 2U, 7U, 64U})
    EXPECT_EQ(text_of(run(text_, setup_, piece).blocks), whole) << piece << " bytes at a time";
}

TEST_P(GoodProgram, ReadsBackAsTheSamePathWithoutCompensation) {
  if (!built_) return;
  const auto wanted = moving(run(text_, setup_, text_.size()).blocks, 1e-5);
  const std::string resolved = resolved_text(text_, setup_);
  const Outcome again = run(resolved, setup_, resolved.size());
  ASSERT_FALSE(again.stopped) << report_of(again.diagnostics) << resolved;
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

TEST(Manifest, NamesProgramsThatExist) {
  for (const auto& [name, state] : read_manifest())
    EXPECT_TRUE(fs::exists(folder / "good" / (name + ".nc"))) << name << ' ' << state;
}

class BadProgram : public ::testing::TestWithParam<std::string> {};

TEST_P(BadProgram, RaisesTheDiagnosticOfItsFirstLine) {
  const std::string text = read_file(folder / "bad" / (GetParam() + ".nc"));
  const ExpectedDiagnostic expected = read_expected_refusal(text);
  const Outcome outcome = run(text, read_setup(text), text.size());
  const auto raised =
      std::find_if(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                   [&](const Diagnostic& diagnostic) { return diagnostic.code == expected.code; });
  ASSERT_NE(raised, outcome.diagnostics.end())
      << "expected " << static_cast<int>(expected.code) << ", got\n"
      << report_of(outcome.diagnostics) << text_of(outcome.blocks);
  if (expected.line) {
    EXPECT_EQ(raised->source.line, *expected.line);
  }
  EXPECT_EQ(outcome.stopped, raised->severity == Severity::error) << report_of(outcome.diagnostics);
  for (const Diagnostic& found : outcome.diagnostics) EXPECT_EQ(english_word_in_german(found), "");
  EXPECT_EQ(first_gap(outcome.blocks), "");
  for (const std::size_t piece : {1U, 5U}) {
    const Outcome pieces = run(text, read_setup(text), piece);
    EXPECT_EQ(report_of(pieces.diagnostics), report_of(outcome.diagnostics));
    EXPECT_EQ(text_of(pieces.blocks), text_of(outcome.blocks));
  }
  const fs::path beginning = folder / "bad" / (GetParam() + ".expected");
  if (fs::exists(beginning)) {
    EXPECT_EQ(difference(outcome.blocks, read_expectation(read_file(beginning)).blocks, true), "");
  }
}

// Every row of the table of codes has a program that raises it.
TEST(Codes, AreEachRaisedByAProgram) {
  std::set<Code> raised;
  for (const std::string& name : programs_in("bad"))
    raised.insert(read_expected_refusal(read_file(folder / "bad" / (name + ".nc"))).code);
  for (const std::string& name : programs_in("good"))
    for (const ExpectedDiagnostic& expected :
         read_expectation(read_file(folder / "good" / (name + ".expected"))).diagnostics)
      raised.insert(expected.code);
  // It takes more than 16 MiB of text: computing_test.cpp raises it.
  raised.insert(Code::computing_text_too_long);
  // They are of calls, tool tables and variables of other dialects: tools_of_programs_test.cpp and
  // kept_variables_test.cpp raise them.
  raised.insert({Code::tool_radius_contradicts, Code::tool_may_have_changed,
                 Code::machine_compensates, Code::given_value_kept});
  for (const CodeRow& row : code_table())
    EXPECT_TRUE(raised.contains(row.code)) << static_cast<int>(row.code) << ' ' << row.cause;
}

INSTANTIATE_TEST_SUITE_P(Programs, BadProgram, ::testing::ValuesIn(programs_in("bad")), test_name);

}  // namespace
}  // namespace trc::support
