#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/base/length_unit.h"
#include "core/messages/help_by_reason.h"
#include "core/nc/convert/conversion.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/program/flow.h"
#include "core/session/program_session.h"
#include "tests/support/contours.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/program_run.h"
#include "tests/support/run.h"

// Programs in the manner of each control. The first line of each says with which tools it runs, or
// with which code it is refused and where: `; radius 5`, `; radius 0.25 in`, `; tool 1 5`,
// `; whole increments`, `; block_skip execute`, `; pass G777 POPEN`, `; refused 900003 line 7`. `;
// path -5 0 L; -5 60 A` says where the motions of the compensated path end, from the first
// selection on: lines and arcs.

namespace trc::support {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(testing_support::source_dir()) / "tests" / "programs" / "dialects";

struct DialectProgram {
  std::string text{};
  int refused = 0;  // code
  std::uint32_t line = 0;
  struct End {
    Point point = Point::Zero();
    bool arc = false;
  };
  std::vector<End> path{};
  ProgramSessionSetup setup{};
};

void read_head(DialectProgram& program) {
  std::istringstream lines(program.text);
  for (std::string line; std::getline(lines, line) && line.starts_with("; ");) {
    std::istringstream words(line.substr(2));
    std::string key;
    std::string unit;
    words >> key;
    if (key == "refused") words >> program.refused >> unit >> program.line;
    if (key == "path") {
      char kind = ' ';
      for (DialectProgram::End end; words >> end.point.x() >> end.point.y() >> kind;
           words.ignore(std::numeric_limits<std::streamsize>::max(), ';')) {
        end.arc = kind == 'A';
        program.path.push_back(end);
      }
    }
    if (key == "radius") {
      double radius = 0;
      words >> radius >> unit;
      program.setup.session.program.mode.tool_radius = radius * (unit == "in" ? mm_per_inch : 1);
    }
    if (key == "whole") program.setup.session.program.whole_numbers = WholeNumbers::increments;
    if (key == "pass")
      while (words >> unit) program.setup.session.program.pass_words.insert(unit);
    if (key == "block_skip") {
      words >> unit;
      program.setup.session.program.block_skip =
          unit == "execute" ? BlockSkip::execute : BlockSkip::leave_out;
    }
    if (key == "tool") {
      std::int64_t number = 0;
      double radius = 0;
      std::int64_t edge = 1;
      std::string name;
      words >> number >> radius;
      ProgramSetup& setup = program.setup.session.program;
      if (words >> edge >> name) setup.tool_names[name] = number;
      setup.tools[row_of_edge(number, edge)] = radius;
    }
  }
}

// A program by its name. Each test is a process of its own, which would read all of them otherwise.
struct ProgramFile {
  std::string name{};
  fs::path path{};
  const Dialect* dialect = nullptr;
};

std::ostream& operator<<(std::ostream& out, const ProgramFile& file) { return out << file.name; }

DialectProgram read(const ProgramFile& file) {
  DialectProgram program{.text = testing_support::content_of(file.path)};
  ProgramSetup& setup = program.setup.session.program;
  setup.dialect = file.dialect->name;
  file.dialect->begin(setup.mode);
  read_head(program);
  return program;
}

std::vector<ProgramFile> all_programs() {
  std::vector<ProgramFile> programs;
  for (const Dialect& dialect : all_dialects()) {
    if (!fs::exists(folder / dialect.spelling)) continue;
    for (const auto& entry : fs::directory_iterator(folder / dialect.spelling))
      programs.push_back(
          {.name = std::string(dialect.spelling) + "_" + entry.path().stem().string(),
           .path = entry.path(),
           .dialect = &dialect});
  }
  std::ranges::sort(programs, {}, &ProgramFile::name);
  return programs;
}

// Each piece in a session of its own.
ProgramRun run_resumed(const std::string& text, const ProgramSessionSetup& setup,
                       std::size_t piece) {
  ProgramRun result;
  std::string state;
  for (std::size_t at = 0; at < text.size() && !result.stopped; at += piece) {
    ProgramSession session(setup);
    if (!state.empty()) {
      std::istringstream stream(state);
      StateReader archive(stream);
      session.load(archive);
    }
    Answers answers;
    if (session.feed(std::string_view(text).substr(at, piece), answers) &&
        at + piece >= text.size())
      session.finish(answers);
    std::ostringstream stream;
    StateWriter archive(stream);
    session.save(archive);
    state = stream.str();
    Answer output = answers.take();
    result.text += output.text;
    std::ranges::move(output.diagnostics, std::back_inserter(result.diagnostics));
    result.stopped = session.diagnostics().stopped();
  }
  return result;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void is_accepted_or_refused_for_the_reason_of_its_head(const DialectProgram& program) {
  const ProgramRun written = to_text(program.text, program.setup);
  if (program.refused == 0) {
    EXPECT_FALSE(written.stopped) << written.report();
    return;
  }
  ASSERT_TRUE(written.stopped);
  EXPECT_TRUE(std::ranges::any_of(written.diagnostics, [&](const Diagnostic& found) {
    return static_cast<int>(found.code) == program.refused &&
           (program.line == 0 || found.source.line == program.line);
  })) << written.report();
}

void makes_the_path_of_its_head(const DialectProgram& program) {
  if (program.path.empty()) return;
  std::vector<CompensatedBlock> path = moving(to_blocks(program.text, program.setup).blocks, 1e-6);
  path.erase(path.begin(), std::ranges::find_if(path, [](const CompensatedBlock& block) {
               return block.origin != Origin::uncompensated || block.normal.from != block.normal.to;
             }));
  while (!path.empty() && path.front().origin == Origin::uncompensated) path.erase(path.begin());
  std::ostringstream all;
  for (const CompensatedBlock& block : path) all << text_of(block) << '\n';
  ASSERT_EQ(path.size(), program.path.size()) << all.str();
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_LT((end_of(path[k].path) - program.path[k].point).norm(), 1e-4) << k << '\n'
                                                                           << all.str();
    EXPECT_EQ(is_arc(path[k].path), program.path[k].arc) << k;
  }
}

// No program of these comes too near to its contour, and what is measured finds none that does:
// one line may have become several motions.
void is_measured_clear(const DialectProgram& program) {
  if (program.refused != 0) return;
  ProgramSessionSetup measured = program.setup;
  measured.session.verify = Verify::enforce;
  for (const std::size_t piece : {0U, 1U}) {
    const ProgramRun written = to_text(program.text, measured, piece);
    EXPECT_FALSE(written.stopped) << written.report();
    EXPECT_EQ(written.text, to_text(program.text, program.setup).text);
  }
  measured.session.program.mode.masking = Masking::on;
  measured.session.program.mode.options.remove_masked_blocks = true;
  const ProgramRun removed = to_text(program.text, measured);
  EXPECT_FALSE(removed.stopped) << removed.report();
}

void gives_the_same_in_pieces(const DialectProgram& program) {
  const ProgramRun whole = to_text(program.text, program.setup);
  for (const std::size_t piece : {1U, 3U, 17U}) {
    const ProgramRun pieces = to_text(program.text, program.setup, piece);
    EXPECT_EQ(pieces.text, whole.text);
    EXPECT_EQ(pieces.report(), whole.report());
  }
}

// A state is saved and read again after each piece, wherever that ends.
void gives_the_same_resumed(const DialectProgram& program) {
  const ProgramRun whole = to_text(program.text, program.setup);
  for (const std::size_t piece : {1U, 23U}) {
    const ProgramRun resumed = run_resumed(program.text, program.setup, piece);
    EXPECT_EQ(resumed.text, whole.text);
    EXPECT_EQ(resumed.report(), whole.report());
  }
}

// No word of TRC is left, and a reader of the output makes the compensated path.
void writes_the_path_in_its_dialect(const DialectProgram& program) {
  if (program.refused != 0) return;
  const ProgramRun written = to_text(program.text, program.setup);
  for (const std::string& line : lines_of(written.text)) {
    const std::string words = std::regex_replace(line, std::regex("\\([^)]*\\)|;.*"), "");
    // There it is for cycles.
    if (words.ends_with("M2")) break;
    if (words.starts_with("G150")) continue;
    EXPECT_FALSE(std::regex_search(words, std::regex("G ?4[12]| R[LR]| APPR L| DEP "))) << line;
    EXPECT_FALSE(std::regex_search(words, std::regex(" FMAX.* F ?[0-9]"))) << line;
  }
  const std::vector<CompensatedBlock> wanted =
      moving(to_blocks(program.text, program.setup).blocks, 1e-3);
  const ProgramRun again = to_blocks(written.text, program.setup);
  ASSERT_FALSE(again.stopped) << again.report() << written.text;
  const std::vector<CompensatedBlock> path = moving(again.blocks, 1e-3);
  ASSERT_EQ(path.size(), wanted.size()) << written.text;
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_EQ(path[k].origin, Origin::uncompensated);
    ASSERT_EQ(is_arc(path[k].path), is_arc(wanted[k].path)) << written.text;
    EXPECT_EQ(path[k].rapid, wanted[k].rapid) << text_of(wanted[k]) << '\n' << written.text;
    EXPECT_NEAR(path[k].rapid ? 0 : path[k].feed - wanted[k].feed, 0, 1e-3) << written.text;
    for (const double t : {0.5, 1.0})
      EXPECT_LT((point_in_space(path[k], t) - point_in_space(wanted[k], t)).norm(), 2e-3)
          << text_of(wanted[k]) << '\n'
          << written.text;
  }
}

// Without its selections a program is the same text again, byte for byte.
void comes_out_as_it_is_without_selections(const DialectProgram& program) {
  if (program.refused != 0) return;
  if (program.text.find("APPR") != std::string::npos) return;  // is one without a side, too
  if (program.setup.session.program.block_skip != BlockSkip::refuse) return;  // its `/` go
  // Of a program that computes the flat one comes out.
  const std::vector<std::string> lines = lines_of(program.text);
  if (std::ranges::any_of(lines, [&](const std::string& line) {
        return program::computes(program.setup.session.program, line);
      }))
    return;
  // D belongs to the selection, wherever it stands in its line.
  const std::string with_tool_beside =
      std::regex_replace(program.text, std::regex("(G ?4[12][^\n]*?) D ?[0-9.]+"), "$1");
  const std::string plain = std::regex_replace(
      with_tool_beside,
      std::regex("G ?4[12](\\.1)?( D ?[0-9.]+)? ?|G13[89] ?| R[LR]| M109| M110| M111| M120 LA20",
                 std::regex::ECMAScript | std::regex::icase),
      "");
  const ProgramRun written = to_text(plain, program.setup);
  ASSERT_FALSE(written.stopped) << written.report() << plain;
  EXPECT_EQ(written.text, plain);
}

// What comes out in another dialect is the same path there, with the same feeds.
void is_the_same_path_in_another_dialect_or_refused(const DialectProgram& program) {
  if (program.refused != 0) return;
  const ProgramRun written = to_text(program.text, program.setup);
  const ProgramSetup& setup = program.setup.session.program;
  for (const Dialect& other : all_dialects()) {
    if (other.name == setup.dialect) continue;
    const ConvertedProgram converted = convert_program(written.text, setup, other.name);
    if (!converted.faults.empty()) continue;
    ProgramSessionSetup read;
    read.session.program.dialect = other.name;
    // D of ISG names a tool of the table, for its length.
    const std::regex tool("T([0-9]+)");
    for (std::sregex_iterator named(converted.text.begin(), converted.text.end(), tool), end;
         named != end; ++named)
      read.session.program.tools[std::stoll((*named)[1])] = 1;
    const auto wanted = moving(to_blocks(written.text, program.setup).blocks, 1e-3);
    const ProgramRun again = to_blocks(converted.text, read);
    ASSERT_FALSE(again.stopped) << again.report() << converted.text;
    const auto path = moving(again.blocks, 1e-3);
    ASSERT_EQ(path.size(), wanted.size()) << converted.text;
    for (std::size_t k = 0; k < path.size(); ++k) {
      EXPECT_EQ(path[k].rapid, wanted[k].rapid) << converted.text;
      EXPECT_NEAR(path[k].rapid ? 0 : path[k].feed - wanted[k].feed, 0, 1e-3) << converted.text;
      EXPECT_LT((point_in_space(path[k], 0.5) - point_in_space(wanted[k], 0.5)).norm(), 2e-3)
          << converted.text;
      EXPECT_LT((point_in_space(path[k], 1) - point_in_space(wanted[k], 1)).norm(), 2e-3)
          << converted.text;
    }
  }
}

// All claims in one process: to start a process takes longer than to try a program.
class OfADialect : public ::testing::TestWithParam<ProgramFile> {};

TEST_P(OfADialect, IsWhatItsHeadSays) {
  const DialectProgram program = read(GetParam());
  is_accepted_or_refused_for_the_reason_of_its_head(program);
  makes_the_path_of_its_head(program);
  is_measured_clear(program);
  gives_the_same_in_pieces(program);
  gives_the_same_resumed(program);
  writes_the_path_in_its_dialect(program);
  comes_out_as_it_is_without_selections(program);
  is_the_same_path_in_another_dialect_or_refused(program);
}

INSTANTIATE_TEST_SUITE_P(
    Programs, OfADialect, ::testing::ValuesIn(all_programs()), [](const auto& tested) {
      std::string name;
      bool upper = true;
      for (const char c : tested.param.name) {
        if (c != '_')
          name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        upper = c == '_';
      }
      return name;
    });

std::vector<Diagnostic> told(const std::string& text, DialectName dialect) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = dialect;
  setup.session.program.tools = {{1, ToolRow(2)}};
  setup.session.program.mode.selection = dialect_of(dialect).selection;
  return to_text(text, setup).diagnostics;
}

// What hangs on an obstacle that has been told is none of its own.
TEST(ObstaclesOfADialect, AreToldOnceWithTheLineOfTheirCause) {
  const auto polar =
      told("G21 G90\nG0 X-60. Y0.\nG16\nG41 D1 G1 X50. Y180.\nY120.\nY60.\nG15\nG40 X80. Y0\nM30\n",
           DialectName::fanuc);
  ASSERT_EQ(polar.size(), 1U);
  EXPECT_EQ(polar[0].source.line, 4U);
  EXPECT_EQ(polar[0].detail, "TRC under polar coordinates, in line 3");

  const auto cycle = told(
      "G21 G90\nG0 X-9. Y0.\nG41 D1 G1 X0 Y0 F100.\nY20.\nG81 X1. Y1. Z-5. R1. F100.\nX5.\nG80\n"
      "G1 X9.\nG40 X20.\nM30\n",
      DialectName::fanuc);
  ASSERT_EQ(cycle.size(), 1U);
  EXPECT_EQ(cycle[0].source.line, 5U);

  const auto scaled = told(  // D-175
      "BEGIN PGM A MM\nTOOL CALL 1 Z\nL X-9 Y-9 R0 FMAX\nCYCL DEF 11.0 SCALING\n"
      "CYCL DEF 11.1 SCL Q5\nL X+0 Y+0 RL F100\nL Y+20\nL X+20\nL X+40 R0\nEND PGM A MM\n",
      DialectName::heidenhain);
  ASSERT_EQ(scaled.size(), 1U);
  EXPECT_EQ(scaled[0].source.line, 6U);
}

// A tool that the table does not hold is told at the word that calls it, not where it is needed.
TEST(ToolsWithoutARadius, AreToldAtTheWordThatCallsThem) {
  const std::string contour = "G0 X-9 Y-9\nG41 G1 X0 Y0 F100\nY20\nX20\nG40 X40\nM30\n";
  const auto expect = [](const std::vector<Diagnostic>& found, std::uint32_t line,
                         std::uint32_t column, const std::string& tool) {
    ASSERT_EQ(found.size(), 1U) << tool;
    EXPECT_EQ(found[0].code, Code::tool_unknown);
    EXPECT_EQ(found[0].source.line, line) << tool;
    EXPECT_EQ(found[0].column, column) << tool;
    EXPECT_EQ(found[0].detail, tool);
  };
  using enum DialectName;
  expect(told("G21\nT5 M6\nT1\n" + contour, fanuc), 2, 1, "T5");
  expect(told("G21\nT5 M6\nG43 H5 D5 Z5.\n" + contour, fanuc), 3, 8, "D5");
  expect(told("G21\nM6 T5\nT1\n" + contour, linuxcnc), 2, 4, "T5");
  expect(told("G71\nT5 D1\nM6\nT1\n" + contour, sinumerik), 2, 1, "T5");
  expect(told("G71\nT1 D2\nM6\n" + contour, sinumerik), 2, 4, "D2 of T1");
  expect(told("G71\nM6 T=\"ABC\"\n" + contour, sinumerik), 2, 4, "\"ABC\"");
  expect(told("G71\nT5 M6\n" + contour, isg), 2, 1, "T5");
  expect(told("BEGIN PGM A MM\n1 TOOL CALL 5 Z\nL X-9 Y-9 R0 FMAX\nL X+0 Y+0 RL F100\nL Y+20\n"
              "L X+20 R0\nEND PGM A MM\n",
              heidenhain),
         2, 3, "5");
}

// H beside G41 is its register; left alone it would change the length.
// A drill is never compensated: its D word is missed where a radius is needed, not before.
TEST(ToolsWithoutARadius, AreNotMissedByMotionsWithoutCorrection) {
  ProgramSessionSetup setup;
  setup.session.program.tools = {{1, ToolRow(5)}};
  const std::string drill = "N10 T17 D17\nN20 G0 X50 Y20\nN30 G1 Z-10 F100\nN40 G0 Z5\n";
  const ProgramRun milled = to_text(
      drill + "N50 T1 D1\nN60 G0 X-20 Y-20\nN70 G41 G1 X0 Y0 F300\nN80 Y40\nN90 G40 X-20\nM30\n",
      setup);
  EXPECT_FALSE(milled.stopped) << milled.report();
  const ProgramRun missed =
      to_text(drill + "N60 G0 X-20 Y-20\nN70 G41 G1 X0 Y0 F300\nN80 Y40\nM30\n", setup);
  ASSERT_TRUE(missed.stopped);
  EXPECT_EQ(missed.diagnostics.back().code, Code::tool_unknown);
  EXPECT_EQ(missed.diagnostics.back().source.line, 1U);
  EXPECT_EQ(missed.diagnostics.back().detail, "D17");
}

TEST(OffsetsOfFanuc, GoWithTheSelectionThatTheyBelongTo) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.selection = Selection::direct;
  setup.session.program.mode.tool_radius = 2;
  const ProgramRun written = to_text(
      "G21 G90\nG43 H4 Z5.\nG0 X-9. Y-9.\nG41 H24 G1 X0 Y0 F100.\nY20.\nX20.\nG40 X40.\nM30\n",
      setup);
  ASSERT_FALSE(written.stopped) << written.report();
  EXPECT_NE(written.text.find("G43 H4 Z5."), std::string::npos);
  EXPECT_EQ(written.text.find("H24"), std::string::npos) << written.text;
}

// Lines that are inserted have numbers too, and the first one stays.
TEST(BlocksNumberedAnew, CountFromTheFirstNumberOn) {  // D-60
  const auto written = [](DialectName dialect, const std::string& text) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect;
    setup.session.program.mode.selection = Selection::direct;
    setup.session.program.mode.transition = dialect_of(dialect).transition;
    setup.session.program.mode.tool_radius = 5;
    setup.session.program.renumbers = true;
    const ProgramRun whole = to_text(text, setup);
    EXPECT_FALSE(whole.stopped) << whole.report();
    EXPECT_EQ(to_text(text, setup, 1).text, whole.text);
    EXPECT_EQ(run_resumed(text, setup, 7).text, whole.text);
    return whole.text;
  };
  EXPECT_EQ(written(DialectName::sinumerik,
                    "; a plate\nN5 G71 G90\nN6  G0 X-20 Y-20\nN7 G41 G1 X0 Y0 F300\nN8 Y40\nX40\n"
                    "N10 G40 X60 Y60\nN12 M30\n"),
            "; a plate\nN5 G71 G90\nN15  G0 X-20 Y-20\nN25 G01 X-5 Y0 F300\nN35 G01 X-5 Y40\n"
            "N45 G02 X0 Y45 I5 J0\nG01 X40 Y45\nN55 G01 X60 Y60\nN65 M30\n");
  EXPECT_EQ(written(DialectName::heidenhain,
                    "0 BEGIN PGM A MM\n1 L X-20 Y-20 R0 FMAX\n2 L X+0 Y+0 RL F300\n3 L Y+40\n"
                    "4 L X+40\n5 L X+60 Y+60 R0\n6 END PGM A MM\n"),
            "0 BEGIN PGM A MM\n1 L X-20 Y-20 R0 FMAX\n2 L X-5 Y+0 F300\n3 L X-5 Y+40\n"
            "4 CC X+0 Y+40\n5 C X+0 Y+45 DR-\n6 L X+40 Y+45\n7 L X+60 Y+60\n8 END PGM A MM\n");
  const std::string unnumbered =
      "G21 G90\nG0 X-20. Y-20.\nG41 G1 X0 Y0 F300.\nY40.\nG40 X60. Y60.\nM30\n";
  EXPECT_EQ(written(DialectName::fanuc, unnumbered).find('N'), std::string::npos);
}

// Bytes of other encodings stay in comments, unless UTF-8 is asked for.
TEST(BytesOfComments, AreKeptAsTheEncodingSays) {
  const auto runs = [](DialectName dialect, Encoding encoding, const std::string& comment) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect;
    setup.session.program.encoding = encoding;
    const std::string text = "G90 " + comment + "\nG0 X1 Y1\nM30\n" + comment + "\n";
    const ProgramRun written = to_text(text, setup);
    if (!written.stopped) {
      EXPECT_EQ(written.text, text);
    }
    return !written.stopped;
  };
  const std::string latin =
      "(Fl\xE4"
      "che)";
  for (const DialectName dialect : {DialectName::isg, DialectName::fanuc, DialectName::linuxcnc}) {
    EXPECT_TRUE(runs(dialect, Encoding::any, latin));
    EXPECT_FALSE(runs(dialect, Encoding::utf8, latin));
    EXPECT_TRUE(runs(dialect, Encoding::utf8,
                     "(Fl\xC3\xA4"
                     "che)"));
  }
  EXPECT_FALSE(runs(DialectName::isg, Encoding::of_dialect, latin));
  EXPECT_TRUE(runs(DialectName::fanuc, Encoding::of_dialect, latin));
}

// D beside G96 of LinuxCNC is no tool, and an arc may be told by its angle: both stay as they are.
TEST(LinesWithoutACorrection, ComeOutAsTheyStand) {
  ProgramSessionSetup setup;
  setup.session.program.tools = {{1, ToolRow(2)}};
  for (const auto& [dialect, text] :
       {std::pair{DialectName::linuxcnc, "G21 G90\nG96 D2500 S120\nG0 X1 Y1\nM2\n"},
        std::pair{DialectName::sinumerik,
                  "G71 G90\nG0 X0 Y0\nG3 AR=90 I5 J0 F500\nG2 X20 AR=120\nG1 X30\nM30\n"}}) {
    setup.session.program.dialect = dialect;
    const ProgramRun written = to_text(text, setup);
    ASSERT_FALSE(written.stopped) << written.report();
    EXPECT_EQ(written.text, text);
  }
}

// Words that are not converted, each with its line.
TEST(FaultsOfReading, AreAllToldInOneRunWithTheNumberOfTheirLines) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  const ProgramRun written =
      to_text("G21\nG999 X1\nG66 P2\nM96 P1\nG0 X0\nG999\nG46 X1\nM30\n", setup);
  ASSERT_EQ(written.diagnostics.size(), 4u) << written.report();
  EXPECT_EQ(written.diagnostics[0].source.line, 2u);
  EXPECT_EQ(written.diagnostics[0].code, Code::nc_unknown_function);
  ASSERT_EQ(written.diagnostics[0].values.size(), 1u);
  EXPECT_EQ(written.diagnostics[0].values[0].value, 2);
  EXPECT_EQ(written.diagnostics[1].source.line, 3u);
  EXPECT_EQ(written.diagnostics[2].source.line, 4u);
  EXPECT_EQ(written.diagnostics[3].source.line, 7u);
  EXPECT_EQ(written.text.find("G0"), std::string::npos) << written.text;
}

// CALL is one obstacle, whatever stands after it.
TEST(FaultsOfReading, NameAStatementOfSinumerikOnce) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::sinumerik;
  const ProgramRun written = to_text("CALL \"SUB\"\nG0 X0\nM30\n", setup);
  ASSERT_EQ(written.diagnostics.size(), 1u) << written.report();
  EXPECT_EQ(written.diagnostics[0].detail, "CALL, a subprogram call");
}

TEST(FaultsOfReading, AreNoMoreThanTheLimit) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.most_faults = 3;
  std::string text;
  for (int k = 200; k < 210; ++k) text += "G" + std::to_string(k) + "\n";
  EXPECT_EQ(to_text(text, setup).diagnostics.size(), 3u);
}

// A line of 64 KiB may have a fault in each byte. What stands after as many as are told is not
// read.
TEST(FaultsOfReading, ALineWithTooManyIsReadNoFurther) {
  for (const DialectName dialect : {DialectName::fanuc, DialectName::linuxcnc,
                                    DialectName::sinumerik, DialectName::heidenhain}) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect;
    std::string line = dialect == DialectName::heidenhain ? "L " : "G1 ";
    for (std::size_t i = 0; i <= setup.most_faults; ++i) line += "X+1 ";
    const ProgramRun written = to_text(line + "? ?\n? ?\n", setup);
    ASSERT_EQ(written.diagnostics.size(), 2u) << dialect_of(dialect).spelling << written.report();
    EXPECT_EQ(written.diagnostics[0].code, Code::nc_word_twice);
    EXPECT_EQ(written.diagnostics[1].source.line, 2u) << written.report();
    EXPECT_EQ(written.diagnostics[1].values.size(), 0u);
  }
}

TEST(TheGuard, NamesTheDialectAProgramLooksLike) {
  for (const auto& [text, dialect] :
       std::vector<std::pair<std::string, std::string>>{{"O1000\nG0 X1\n", "fanuc"},
                                                        {"G20 G90\nG0 X1\n", "fanuc"},
                                                        {"G21\nG0 X1\n", "fanuc"},
                                                        {"G0 X1\nG91 G28 Z0\n", "fanuc"},
                                                        {"G43 H1 Z5\n", "fanuc"},
                                                        {"G81 X1 Y1 Z-5 R2 F100\n", "fanuc"},
                                                        {"M98 P1000\n", "fanuc"},
                                                        {"G10 L2 P1 X0 Y0\n", "fanuc"},
                                                        {"G41.1 D5\n", "linuxcnc"},
                                                        {"G52 X10 Y10\n", ""},
                                                        {"G25 X10 Y10\n", ""},
                                                        {"TRANS X10\n", "sinumerik"},
                                                        {"G2 X10 Y0 CR=5\n", "sinumerik"},
                                                        {"L X+10 Y+20\n", "heidenhain"}}) {
    const ProgramRun written = to_text(text);
    ASSERT_TRUE(written.stopped) << text;
    EXPECT_EQ(written.diagnostics[0].code, Code::other_dialect) << text << written.report();
    EXPECT_NE(written.diagnostics[0].detail.find(dialect), std::string::npos) << written.report();
  }
}

TEST(TheGuard, LeavesProgramsOfIsgAlone) {
  for (const char* text : {"#TRC [REVERSE=1]\nG20\nG0 X1\n", "G138\nG26 X1 Y1\n", "G25\nG1 X1\n"})
    EXPECT_FALSE(to_text(text).stopped) << text;
}

// SINUMERIK ONE, programming manual 2.10.4: as the tool came up to DISCL= over the contour, with
// FAD= from there down under G341, or along the lead under G340; back with the feed of the contour,
// and from the clearance on as the block says.
TEST(SoftLeads, TravelAcrossThePlaneInTheirStepsAndFeeds) {  // D-130
  const auto text_of_program = [](const std::string& steps) {
    ProgramSessionSetup setup;
    ProgramSetup& program = setup.session.program;
    program.dialect = DialectName::sinumerik;
    program.mode.selection = Selection::direct;
    program.mode.transition = Transition::circular;
    program.mode.tool_radius = 5;
    const ProgramRun written = to_text(
        "G17 G71 G90 G94\nG0 X-20 Y-20 Z20\nG41 " + steps +
            " G247 DISR=10 DISCL=2 FAD=100 X0 Y30 Z-5 F300\nG1 Y60\nX80\nG0 G40 G248 DISR=10 "
            "DISCL=AC(3) X120 Y100 Z50\nM30\n",
        setup);
    EXPECT_FALSE(written.stopped) << written.report();
    return written.text;
  };
  const std::string in_front = "G17 G71 G90 G94\nG0 X-20 Y-20 Z20\nG00 X-15 Y20 ";
  const std::string contour = "G02 X0 Y65 I5 J0\nG01 X80 Y65\n";
  EXPECT_EQ(text_of_program("G341"),
            in_front + "G341 F300\nG00 Z-3\nG01 Z-5 F100\nG03 X-5 Y30 I0 J10 F300\nG01 X-5 Y60\n" +
                contour + "G03 X90 Y75 I0 J10\nG01 Z3\nG00 Z50\nG00 X120 Y100\nM30\n");
  EXPECT_EQ(text_of_program("G340"),
            in_front + "G340 F300\nG00 Z-3\nG03 X-5 Y30 Z-5 I0 J10 F100\nG01 X-5 Y60 F300\n" +
                contour + "G03 X90 Y75 Z3 I0 J10\nG00 Z50\nG00 X120 Y100\nM30\n");
}

// The most dangerous word there is: inches read as millimetres.
TEST(Inches, CountAsInchesInEveryDialect) {
  for (const DialectName name : {DialectName::fanuc, DialectName::linuxcnc}) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = name;
    const ProgramRun written = to_blocks("G20 G90\nG0 X1. Y2.\nM30\n", setup);
    ASSERT_FALSE(written.stopped) << written.report();
    EXPECT_DOUBLE_EQ(end_of(moving(written.blocks, 1e-3).back().path).x(), 25.4);
    setup.session.program.inch = true;
    const ProgramRun declared = to_blocks("G0 X1. Y2.\nM30\n", setup);
    EXPECT_DOUBLE_EQ(end_of(moving(declared.blocks, 1e-3).back().path).y(), 50.8);
  }
}

TEST(Positions, AreUnknownAfterALineThatIsOnlyCopied) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.tool_radius = 1;
  const ProgramRun refused = to_text("G0 X0 Y0\nG28 X0\nG41 D1 G1 Y10. F100\nY20.\n", setup);
  ASSERT_TRUE(refused.stopped);
  EXPECT_EQ(refused.diagnostics.back().code, Code::position_unknown);
  EXPECT_FALSE(
      to_text("G0 X0 Y0\nG28 X0\nG0 X0\nG41 D1 G1 Y10. F100\nX9.\nG40 X20.\nM30\n", setup).stopped);
}

// Of the motions of a text, the points where they end.
std::vector<Point> ends_of(const std::string& text, DialectName name) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = name;
  const ProgramRun written = to_blocks(text, setup);
  EXPECT_FALSE(written.stopped) << written.report();
  std::vector<Point> ends;
  for (const CompensatedBlock& block : moving(written.blocks, 1e-6))
    ends.push_back(end_of(block.path));
  return ends;
}

// A corner that a word cuts is the contour with the cut written out: 10 x 10 at 90 degrees.
TEST(Corners, AreCutAsTheirWordsSay) {  // D-124
  const std::string head = "G90 G17\nG0 X-9 Y-9\nG41 D1 G1 X0 Y0 F100\n";
  const std::string tail = "\nY-4\nG40 X-9 Y-9\nM30\n";
  const double leg = 2 / std::sqrt(2.0);  // of a chamfer 2 mm long
  const std::string short_of = std::to_string(20 - leg);
  struct Case {
    DialectName name;
    std::string word;
    std::string written_out;
  };
  for (const Case& tested :
       {Case{DialectName::fanuc, "Y20 ,R5\nX30", "Y15\nG2 X5 Y20 I5 J0\nG1 X30"},
        Case{DialectName::fanuc, "Y20 ,C3.\nM8\nX30", "Y17\nX3 Y20\nM8\nX30"},
        Case{DialectName::sinumerik, "Y20 RND=5\nX30", "Y15\nG2 X5 Y20 CR=5\nG1 X30"},
        Case{DialectName::sinumerik, "Y20 CHR=3\nX30", "Y17\nX3 Y20\nX30"},
        Case{DialectName::sinumerik, "Y20 CHF=2\nX30",
             "Y" + short_of + "\nX" + std::to_string(leg) + " Y20\nX30"}}) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = tested.name;
    setup.session.program.mode.tool_radius = 2;
    setup.session.program.mode.selection = Selection::direct;
    const ProgramRun cut = to_blocks(head + tested.word + tail, setup);
    const ProgramRun out = to_blocks(head + tested.written_out + tail, setup);
    ASSERT_FALSE(cut.stopped) << tested.word << cut.report();
    ASSERT_FALSE(out.stopped) << tested.word << out.report();
    const auto path = moving(cut.blocks, 1e-3);
    const auto wanted = moving(out.blocks, 1e-3);
    ASSERT_EQ(path.size(), wanted.size()) << tested.word;
    for (std::size_t k = 0; k < path.size(); ++k)
      for (const double t : {0.0, 0.5, 1.0})
        EXPECT_LT((point_at(path[k].path, t) - point_at(wanted[k].path, t)).norm(), 2e-6)
            << tested.word << ' ' << k;
    const std::string text = to_text(head + tested.word + tail, setup).text;
    EXPECT_EQ(text.find(','), std::string::npos) << text;
    EXPECT_EQ(text.find("RND"), std::string::npos) << text;
    EXPECT_EQ(text.find("CH"), std::string::npos) << text;
  }
}

// Counter-clockwise arcs with the tool inside, then outside: a contact point at 10 mm with the
// centre at 6 mm, and at 14 mm.
TEST(FeedAtInsideArcs, IsThatOfTheContactPointThereAlone) {  // D-125
  const std::string contour =
      "X50\nG3 X60 Y10 CR=10\nG1 Y30\nG2 X70 Y40 CR=10\nG1 X90\nG40 X99 Y60\n";
  for (const auto& [word, inside, outside] :
       {std::tuple{"CFIN", 60.0, 100.0}, std::tuple{"CFC", 60.0, 140.0},
        std::tuple{"CFTCP", 100.0, 100.0}, std::tuple{"", 60.0, 140.0}}) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = DialectName::sinumerik;
    setup.session.program.mode.tool_radius = 4;
    dialect_of(DialectName::sinumerik).begin(setup.session.program.mode);
    const ProgramRun written = to_blocks(
        "G0 X30 Y30\n" + std::string(word) + "\nG41 G1 X40 Y0 F100\n" + contour + "M30\n", setup);
    ASSERT_FALSE(written.stopped) << written.report();
    std::vector<double> feeds;
    for (const CompensatedBlock& block : moving(written.blocks, 1e-3))
      if (is_arc(block.path)) feeds.push_back(block.feed);
    ASSERT_EQ(feeds.size(), 2u);
    EXPECT_NEAR(feeds[0], inside, 1e-9) << word;
    EXPECT_NEAR(feeds[1], outside, 1e-9) << word;
  }
}

// Sinumerik begins with G1, ISG with G0; elsewhere the program has to say it (D-62).
TEST(MotionsBeforeAnyFunction, AreThoseOfTheControlOrRefused) {
  const std::string words = "G90 G17 F300\nX-20. Y-20.\nG41 X0. Y0.\nY40.\nX60.\n";
  for (const Dialect& dialect : all_dialects()) {
    if (dialect.name == DialectName::heidenhain) continue;
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect.name;
    setup.session.program.mode.tool_radius = 5;
    dialect.begin(setup.session.program.mode);
    const ProgramRun written = to_blocks(words + "G40 X80. Y60.\nM30\n", setup);
    if (dialect.motion) {
      ASSERT_FALSE(written.stopped) << dialect.spelling << written.report();
      for (const CompensatedBlock& block : moving(written.blocks, 1e-3))
        EXPECT_EQ(block.rapid, dialect.motion == MotionKind::rapid) << dialect.spelling;
      continue;
    }
    ASSERT_TRUE(written.stopped) << dialect.spelling;
    EXPECT_EQ(written.diagnostics.back().code, Code::motion_unknown);
    EXPECT_EQ(written.diagnostics.back().source.line, 3U);
    const ProgramRun said = to_blocks("G1\n" + words + "G40 X80. Y60.\nM30\n", setup);
    EXPECT_FALSE(said.stopped) << dialect.spelling << said.report();
  }
}

// Lists have the positions of a pattern in lines of their own.
TEST(Klartext, CopiesTheLinesOfAPattern) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  const std::string text =
      "BEGIN PGM A MM\nPATTERN DEF\nPOS1( X+25 Y+33.5 Z+0 )\n  POS2 (X+15 IY+6,5 Z+0)\n"
      "PATTERN DEF\nCIRC1 (X+25 Y+33 D80 START+45 NUM8 Z+0)\nCYCL CALL PAT FMAX M3\n"
      "END PGM A MM\n";
  const ProgramRun copied = to_text(text, setup);
  EXPECT_EQ(copied.text, text) << copied.report();
  EXPECT_TRUE(to_text("BEGIN PGM A MM\nPOS X+25\nEND PGM A MM\n", setup).stopped);
}

// A circle cannot lead to the contour, and the line in front of it leads nowhere.
TEST(Klartext, NamesTheMotionWithoutLengthInFrontOfACircle) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 4;
  dialect_of(DialectName::heidenhain).begin(setup.session.program.mode);
  const auto refused = [&](const std::string& in_front) {
    const ProgramRun ran = to_text("BEGIN PGM A MM\nL X+0 Y+20 R0 FMAX\nCC X+20 Y+20\n" + in_front +
                                       "C X+0 Y+20 DR-\nL X-30 R0\nEND PGM A MM\n",
                                   setup);
    return ran.report();
  };
  const std::string named = refused("L X+0 Y+20 RL F300\n");
  EXPECT_NE(named.find("the motion before it has no length"), std::string::npos) << named;
  EXPECT_NE(named.find("selection block line 4"), std::string::npos) << named;
  for (const char* other : {"L RL F300\n", "L RL F300\nM8\n", "L RL F300\nL Z-5\n"}) {
    const std::string plain = refused(other);
    EXPECT_NE(plain.find("90008"), std::string::npos) << other << plain;
    EXPECT_EQ(plain.find("no length"), std::string::npos) << other << plain;
  }
}

// The CC of an arc stands where that of the program stood, and has its number.
TEST(Klartext, KeepsTheNumberOfAPole) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 5;
  dialect_of(DialectName::heidenhain).begin(setup.session.program.mode);
  const std::string text =
      "0 BEGIN PGM A MM\n1 L X-20 Y-20 R0 FMAX\n2 L X+0 Y+0 RL F300\n3 L Y+40\n4 CC X+20 Y+40\n"
      "5 C X+40 Y+40 DR-\n6 L Y+20\n7 CC X+45 Y+20\n8 ; a corner of its own\n9 L X+60\n"
      "10 CC X+60 Y+10 ; the last\n11 C X+60 Y+0 DR-\n12 L X-20 R0\n13 END PGM A MM\n";
  const ProgramRun written = to_text(text, setup);
  ASSERT_FALSE(written.stopped) << written.report();
  EXPECT_EQ(written.text,
            "0 BEGIN PGM A MM\n1 L X-20 Y-20 R0 FMAX\n2 L X-5 Y+0 F300\n3 L X-5 Y+40\n"
            "4 CC X+20 Y+40\n5 C X+45 Y+40 DR-\n6 L X+45 Y+25\n8 ; a corner of its own\n"
            "9 L X+60 Y+25\n10 ; the last\nCC X+60 Y+10\n11 C X+60 Y-5 DR-\n"
            "12 L X-20 Y+0\n13 END PGM A MM\n");
  EXPECT_EQ(to_text(text, setup, 1).text, written.text);
  EXPECT_EQ(run_resumed(text, setup, 7).text, written.text);
}

// The feed of TOOL CALL holds until another one is programmed.
TEST(Klartext, TakesTheFeedOfTheToolCall) {
  const std::string program =
      "BEGIN PGM A MM\nTOOL CALL 1 Z S3000 F500\nL X-20 Y-20 R0 FMAX M3\nL Z-3\nL X+0 Y+0 RL\n"
      "L Y+50\nL X+40 F200\nL Y+0\nL X+0\nL X-20 Y-20 R0\nEND PGM A MM\n";
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 5;
  dialect_of(DialectName::heidenhain).begin(setup.session.program.mode);
  const ProgramRun written = to_blocks(program, setup);
  ASSERT_FALSE(written.stopped) << written.report();
  for (const CompensatedBlock& block : moving(written.blocks, 1e-3)) {
    if (block.rapid) continue;
    EXPECT_EQ(block.feed, block.source.line < 7 ? 500 : 200) << block.source.line;
  }
  const ProgramRun text = to_text(program, setup);
  EXPECT_NE(text.text.find("TOOL CALL 1 Z S3000 F500\nL X-20 Y-20 R0 FMAX M3\nL Z-3\n"),
            std::string::npos)
      << text.text;
  EXPECT_EQ(text.text.find("F500", text.text.find("L Z-3")), std::string::npos) << text.text;
}

// In G91 the R of G10 is a sum, wherever in the block the G91 stands.
TEST(ToolDataOfAProgram, ThatAreASumAreRefused) {
  for (const char* sum :
       {"G91 G10 L12 P1 R0.5\nG90\n", "G10 L12 G91 P1 R0.5\nG90\n", "G91 G10 P1 R0.5\nG90\n"}) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = DialectName::fanuc;
    setup.session.program.tools = {{1, ToolRow(5)}};
    const ProgramRun written = to_blocks("G21 G90 G17\nG0 X-20. Y-20.\n" + std::string(sum) +
                                             "G41 D1 G1 X0. Y0. F300.\nY40.\nX60.\nG40 X80.\nM30\n",
                                         setup);
    ASSERT_TRUE(written.stopped) << sum;
    EXPECT_EQ(written.diagnostics.back().code, Code::nc_unsupported) << sum;
  }
}

// The rounding between a line and an arc touches both: its centre is a radius away from either.
TEST(Corners, AreRoundedBesideArcs) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.tools[1] = 0;
  setup.session.program.mode.selection = Selection::direct;
  const ProgramRun written = to_blocks(
      "G0 X-9 Y-9\nG42 D1 G1 X0 Y0 F9\nX40 ,R5\nG3 X40 Y30 I-9 J15 ,R4\nG1 X0\nG40 X-9\nM30\n",
      setup);
  ASSERT_FALSE(written.stopped) << written.report();
  std::vector<Arc> arcs;
  for (const CompensatedBlock& block : moving(written.blocks, 1e-6))
    if (const Arc* arc = std::get_if<Arc>(&block.path)) arcs.push_back(*arc);
  ASSERT_EQ(arcs.size(), 3u);
  const Point center(31, 15);
  const double radius = std::hypot(9.0, 15.0);
  EXPECT_LT((arcs[1].center - center).norm(), 1e-9);
  EXPECT_NEAR(arcs[0].center.y(), 5, 1e-9);
  EXPECT_NEAR((arcs[0].center - center).norm(), radius - 5, 1e-9);
  EXPECT_NEAR(arcs[2].center.y(), 26, 1e-9);
  EXPECT_NEAR((arcs[2].center - center).norm(), radius - 4, 1e-9);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_LT((tangent_at_end(arcs[k]) - tangent_at_start(arcs[k + 1])).norm(), 1e-6) << k;
}

TEST(Corners, ThatHaveNoPlaceAreRefused) {  // D-124
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.tool_radius = 2;
  setup.session.program.mode.selection = Selection::direct;
  const std::string head = "G90 G17\nG0 X-9 Y-9\n";
  for (const char* contour : {"G41 D1 G1 X0 Y0 ,R3 F100\nY20\nX30\nG40 X-9\n",
                              "G41 D1 G1 X0 Y0 F100\nY20 ,R25\nX30\nG40 X-9\n",
                              "G41 D1 G1 X0 Y0 F100\nY20 ,R2\nG40 X-9\n",
                              "G41 D1 G1 X0 Y0 F100\nX30 Z5 ,R2\nY9\nG40 X-9\n",
                              "G41 D1 G1 X0 Y0 F100\nY20\nX30 ,C2\nM30\n"}) {
    const ProgramRun refused = to_text(head + contour, setup);
    ASSERT_TRUE(refused.stopped) << contour;
    EXPECT_EQ(refused.diagnostics.back().code, Code::nc_unsupported) << contour;
  }
}

// By its manual a corner of FANUC that does not turn is a block of no length.
TEST(Corners, AreNoneWhereTheContourDoesNotTurn) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.tool_radius = 2;
  const auto rounded = [&](const std::string& word) {
    return to_text("G90 G17\nG0 X-9 Y-9\nG41 D1 G1 X0 Y0 F100\nY20" + word + "\nG2 X10 Y30 R10" +
                       word + "\nG1 X30\nG40 Y40\nM30\n",
                   setup)
        .text;
  };
  EXPECT_EQ(rounded(" ,R2"), rounded(""));
  const ProgramRun back = to_text(
      "G90 G17\nG0 X-9 Y-9\nG41 D1 G1 X0 Y0 F100\nG3 X0 Y20 R10 ,R2\nG3 X0 Y60 R20\nG40 G1 "
      "X9\nM30\n",
      setup);
  ASSERT_TRUE(back.stopped);
  EXPECT_EQ(back.diagnostics.back().detail, "a rounding or a chamfer where the contour turns back");
}

TEST(PolarWords, MeanThePointsThatTheyAreWorth) {
  const std::string head = "G17 G90 G71\nG0 X5 Y5\n";
  const auto polar = ends_of(head +
                                 "G111 X20 Y30\nG1 RP=10 AP=0 F100\nG3 AP=90\nG1 RP=25\n"
                                 "G110 X1 Y2\nG1 AP=180 RP=4\n"
                                 "G112 X3 Y-3\nG1 AP=270 RP=2\nM30\n",
                             DialectName::sinumerik);
  const auto points = ends_of(head +
                                  "G1 X30 Y30 F100\nG3 X20 Y40 I-10 J0\nG1 X20 Y55\n"
                                  "G1 X17 Y57\nG1 X24 Y52\nM30\n",
                              DialectName::sinumerik);
  ASSERT_EQ(polar.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_LT((polar[k] - points[k]).norm(), 1e-9) << k;
}

TEST(PolarWords, AreNotFollowedAfterAFrameThatMovedTheirPole) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::sinumerik;
  setup.session.program.mode.tool_radius = 1;
  const ProgramRun refused =
      to_text("G0 X0 Y0\nG111 X20 Y30\nTRANS X5\nG1 RP=10 AP=0 F100\nG41 G1 X9\nY9\n", setup);
  ASSERT_TRUE(refused.stopped);
  EXPECT_EQ(refused.diagnostics.back().code, Code::position_unknown);
}

TEST(PolarWords, AloneDoNotCountOnOnesThatAreNotWritten) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::sinumerik;
  setup.session.program.mode.tool_radius = 1;
  setup.session.program.mode.selection = Selection::direct;
  const std::string contour = "G0 X60 Y0\nG111 X20 Y0\nG41 G1 RP=30 AP=0 F100\nAP=90\nG40 X0 Y60\n";
  const ProgramRun refused = to_text(contour + "G0 AP=180\nM30\n", setup);
  ASSERT_TRUE(refused.stopped);
  EXPECT_EQ(refused.diagnostics.back().code, Code::nc_unsupported);
  EXPECT_FALSE(to_text(contour + "G0 RP=40 AP=180\nAP=90\nM30\n", setup).stopped);
}

// It compensates nothing, and no contour runs so without a word.
TEST(RegisterZero, IsToldWithTheFirstContourOfIt) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.selection = Selection::direct;
  const std::string contour = "G41 D0 G1 X0 Y0 F9\nY9\nG40 X-9 Y-9\n";
  const ProgramRun written = to_blocks("G0 X-9 Y-9\n" + contour + contour + "M2\n", setup);
  EXPECT_FALSE(written.stopped);
  ASSERT_EQ(written.diagnostics.size(), 1u) << written.report();
  EXPECT_EQ(written.diagnostics[0].code, Code::tool_radius_zero);
  EXPECT_EQ(written.diagnostics[0].source.line, 2u);
  setup.session.program.tools[0] = 2;
  EXPECT_TRUE(to_blocks("G0 X-9 Y-9\n" + contour + "M2\n", setup).diagnostics.empty());
}

// LinuxCNC: the tool in the spindle; where nobody has loaded one, nobody knows which.
TEST(RegisterZero, IsTheToolInTheSpindleOfLinuxcnc) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::linuxcnc;
  setup.session.program.mode.selection = Selection::direct;
  setup.session.program.tools[4] = 2;
  const std::string contour = "G0 X-9 Y-9\nG41 D0 G1 X0 Y0 F9\nY9\nG40 X-9 Y-9\nM2\n";
  const ProgramRun loaded = to_text("T4 M6\n" + contour, setup);
  EXPECT_TRUE(loaded.diagnostics.empty()) << loaded.report();
  EXPECT_NE(loaded.text.find("G01 X-2 Y0"), std::string::npos) << loaded.text;
  EXPECT_EQ(to_blocks(contour, setup).diagnostics.back().code, Code::no_tool_radius);
  setup.session.program.tools[0] = 3;
  EXPECT_NE(to_text("T4 M6\n" + contour, setup).text.find("G01 X-3 Y0"), std::string::npos);
}

// A row of a table of corrections has a DR that is not known here.
TEST(Klartext, ATableOfCorrectionsHoldsUpToTheNextTool) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.tools[1] = 4;
  setup.session.program.mode.selection = Selection::direct;
  const std::string head = "BEGIN PGM T MM\nTOOL CALL 1 Z S900\n";
  const std::string contour =
      "L X-20 Y-20 R0 FMAX\nL X+0 Y+0 RL F500\nL Y+50\nL X-20 Y-20 R0\nEND PGM T MM\n";
  const ProgramRun refused = to_text(head + "FUNCTION CORRDATA TCS #2\n" + contour, setup);
  ASSERT_TRUE(refused.stopped);
  EXPECT_EQ(refused.diagnostics.back().code, Code::nc_unsupported);
  for (const char* const end : {"FUNCTION CORRDATA RESET TCS\n", "TOOL CALL 1 Z S900\n"}) {
    const ProgramRun written = to_text(head + "FUNCTION CORRDATA TCS #2\n" + end + contour, setup);
    EXPECT_FALSE(written.stopped) << end << written.report();
  }
}

// What it writes into the table of tools is not known to the table that is given here.
TEST(Klartext, AProgramThatWritesTheRadiusOfAToolIsNotCompensated) {  // D-72
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.tools[1] = 4;
  const std::string contour =
      "TOOL CALL 1 Z S900\nL X-20 Y-20 R0 FMAX\nL X+0 Y+0 RL F500\nL Y+50\nL X-20 Y-20 R0\n"
      "END PGM T MM\n";
  const std::string head = "BEGIN PGM T MM\nFN 17: SYSWRITE ";
  for (const char* const writes : {"ID50 NR2 IDX1 = +6\n", "ID 50 NR5 IDX Q1 = Q2\n",
                                   "ID950 NRQ3 = +6\n", "IDQ1 NR2 IDX1 = +6\n"}) {
    const ProgramRun refused = to_text(head + writes + contour, setup);
    ASSERT_TRUE(refused.stopped) << writes;
    EXPECT_EQ(refused.diagnostics.back().code, Code::nc_unsupported) << writes;
  }
  EXPECT_FALSE(to_text(head + "ID50 NR1 IDX1 = +60\n" + contour, setup).stopped);
}

// Whoever ended the contour there would cut away its wall.
TEST(Klartext, HelpsWithinAContourWithoutEndingIt) {
  for (const char* const detail :
       {"Q2, a variable, while TRC is active", "FLT while TRC is active", "FC while TRC is active",
        "M97, corners of small steps", "M98, open corners, while TRC is active"}) {
    const std::string_view help = help_by_reason(detail, Language::english);
    EXPECT_FALSE(help.empty()) << detail;
    EXPECT_EQ(help.find("begin it anew"), std::string_view::npos) << detail;
  }
}

TEST(Klartext, ACalledProgramFindsTheFeed) {  // D-70
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.tools[1] = 4;
  setup.session.program.mode.selection = Selection::direct;
  const ProgramRun done = to_text(
      "BEGIN PGM T MM\nTOOL CALL 1 Z S900\nL X-20 Y-20 R0 FMAX\nL X+0 Y-10 RL F500 M109\nL Y+40\n"
      "CR X+10 Y+50 R+10 DR-\nL Y+80 R0 FMAX\nCALL PGM K\nEND PGM T MM\n",
      setup);
  EXPECT_FALSE(done.stopped) << done.report();
  EXPECT_NE(done.text.find("M109\nL F500\nCALL PGM K\n"), std::string::npos) << done.text;
}

// The feed that CFC has made of the last arc is not that of what is copied after it.
TEST(Sinumerik, WhatIsCopiedMovesAtTheFeedOfTheProgram) {  // D-70
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::sinumerik;
  setup.session.program.mode.tool_radius = 5;
  setup.session.program.mode.selection = Selection::direct;
  setup.session.program.mode.feed_adaptation = FeedAdaptation::on;
  const std::string contour =
      "G17 G90 G71\nT1 D1 M6\nG0 X-20 Y-20\nG1 G41 X0 Y-10 F500\nY40\nG2 X10 Y50 CR=10\n"
      "G40 G0 Y80\n";
  const auto ending = [&](const std::string& text) {
    const ProgramRun done = to_text(contour + text, setup);
    EXPECT_FALSE(done.stopped) << done.report();
    return done.text.substr(done.text.find("G00 X10 Y80\n") + 12);
  };
  for (const char* const copied :
       {"CYCLE81(5,0,1,-5)\n", "MYSUB(1)\n", "G53 G1 X100 Y100\n", "SUPA G1 Z5\n", "G1 X=R1\n"})
    EXPECT_EQ(ending(copied), std::string("F500\n") + copied);
  // Rapid, with a feed of its own, or without a motion.
  for (const char* const copied :
       {"SUPA G0 Z5\n", "G53 G0 X0\n", "G1 X=R1 F90\n", "M5\n", "G54\n", "TRANS X10\n"})
    EXPECT_EQ(ending(copied), copied);
}

TEST(Sinumerik, HasSettableFramesUpToG599) {
  const Dialect& dialect = dialect_of(DialectName::sinumerik);
  for (const int number : {505, 549, 599}) {
    const GFunction* const function = dialect.function(number);
    ASSERT_NE(function, nullptr) << number;
    EXPECT_EQ(function->group, GGroup::zero_shift) << number;
  }
  EXPECT_EQ(dialect.function(504), nullptr);
}

TEST(Sinumerik, SplinesAndTrcInSpaceAreNoContours) {  // D-73
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::sinumerik;
  setup.session.program.mode.tool_radius = 5;
  const std::string contour = "G41 X0 Y0 F500\nY50\nG40 X-20\nM30\n";
  const std::string head = "G17 G90 G71\nT1 D1 M6\nG0 X-20 Y-20\n";
  for (const char* const name : {"ASPLINE", "BSPLINE", "CSPLINE", "POLY", "CUT3DC", "CUT3DF",
                                 "TRANSMIT", "TOROT", "MEAFRAME"}) {
    EXPECT_EQ(fault_of_pass_word(name, DialectName::sinumerik), "is known") << name;
    const ProgramRun refused = to_text(head + name + "\n" + contour, setup);
    EXPECT_TRUE(refused.stopped) << name;
  }
  const std::string spline = "CSPLINE X0 Y0 F500\nX10 Y10\nX20 Y0\n";
  const ProgramRun copied = to_text(head + spline + "G0 X-20 Y-20\nG1 " + contour, setup);
  EXPECT_FALSE(copied.stopped) << copied.report();
  EXPECT_NE(copied.text.find(spline), std::string::npos);
  const ProgramRun flat =
      to_text(head + "CUT3DC\nG1 X5 F90\nCUT2D\nG0 X-20 Y-20\nG1 " + contour, setup);
  EXPECT_FALSE(flat.stopped) << flat.report();
}

TEST(Linuxcnc, AToolOffsetInThePlaneMovesTheCoordinates) {  // D-71
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::linuxcnc;
  setup.session.program.mode.tool_radius = 5;
  const std::string contour = "G91 G41 D1 G1 X20 F500\nG90 Y50\nG40 X-20\nM2\n";
  const std::string head = "G21 G90 G17\nT1 M6\nG0 X-20 Y-20\n";
  for (const char* const offset : {"G43.1 X5\n", "G43.2 X5\n", "G43.1 X5\nG0 X-20 Y-20\nG49\n"}) {
    const ProgramRun refused = to_text(head + offset + contour, setup);
    ASSERT_TRUE(refused.stopped) << offset;
    EXPECT_EQ(refused.diagnostics.back().code, Code::position_unknown) << offset;
  }
  for (const char* const offset : {"G43.1 Z5\n", "G43 H1\n", "G49\n"})
    EXPECT_FALSE(to_text(head + offset + contour, setup).stopped) << offset;
}

TEST(Klartext, IsPassedOnWhereNothingIsCompensated) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  const std::string text =
      "0 BEGIN PGM RR12 MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 TOOL CALL \"RL 5\" Z S900 ; RL\n"
      "3 L X+10 Y+5 R0 FMAX M3\n4 CR X+20 Y+5 R+30 DR-\n5 CYCL DEF 203 ~\n   Q200=1 ;GAP \xE4\n"
      "6 END PGM RR12 MM\n";
  EXPECT_EQ(to_text(text, setup).text, text);
  for (const char* contour : {"9 X+3 R+ F90\n", "9 L X+3 R- F90\n", "9 IX+3 RL\n",
                              "N40 G01 G41 X+5 Y+5*\n", "9 VANISH 3\n", "9 L X+1 VANISH\n"}) {
    const ProgramRun refused = to_text(contour + text, setup);
    ASSERT_TRUE(refused.stopped) << contour;
    EXPECT_EQ(refused.diagnostics.back().code, Code::nc_unsupported) << contour;
  }
}

// One part in Klartext and in words of Fanuc; `radius` of the tool.
struct Twins {
  std::string name{};
  std::string klartext{};
  std::string fanuc{};
  double radius = 4;
};

std::ostream& operator<<(std::ostream& out, const Twins& part) { return out << part.name; }

class SamePart : public ::testing::TestWithParam<Twins> {};

TEST_P(SamePart, HasTheSamePath) {
  const Twins& part = GetParam();
  const auto path_of = [&](DialectName dialect, const std::string& text) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect;
    setup.session.program.mode.tool_radius = part.radius;
    setup.session.program.mode.selection = Selection::direct;
    setup.session.program.mode.transition = Transition::circular;
    const ProgramRun written = to_blocks(text, setup);
    EXPECT_FALSE(written.stopped) << written.report() << text;
    return moving(written.blocks, 1e-6);
  };
  const auto klartext =
      path_of(DialectName::heidenhain, "BEGIN PGM A MM\nTOOL CALL 1 Z S900\nL X-30 Y-30 R0 FMAX\n" +
                                           part.klartext + "END PGM A MM\n");
  const auto fanuc =
      path_of(DialectName::fanuc, "G17 G21 G90\nT1 M6\nG0 X-30 Y-30\n" + part.fanuc + "M30\n");
  ASSERT_EQ(klartext.size(), fanuc.size());
  for (std::size_t k = 0; k < fanuc.size(); ++k) {
    ASSERT_EQ(is_arc(klartext[k].path), is_arc(fanuc[k].path)) << k;
    EXPECT_EQ(klartext[k].rapid, fanuc[k].rapid) << k;
    EXPECT_NEAR(klartext[k].rapid ? 0 : klartext[k].feed - fanuc[k].feed, 0, 1e-9) << k;
    for (const double t : {0.0, 0.3, 1.0})
      EXPECT_LT((point_at(klartext[k].path, t) - point_at(fanuc[k].path, t)).norm(), 1e-6)
          << k << ' ' << text_of(klartext[k]) << ' ' << text_of(fanuc[k]);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Klartext, SamePart,
    ::testing::Values(
        Twins{"Square", "L X+0 Y+0 RL F300\nL Y+50\nL X+70\nL Y-9\nL X-30 Y-30 R0 FMAX\n",
              "G41 D1 G1 X0 Y0 F300\nY50\nX70\nY-9\nG0 G40 X-30 Y-30\n"},
        Twins{"Increments", "L X+0 Y+0 RR F300\nL IX+50\nL IX+5 Y+30\nL X-3 IY+9\nL X-30 R0\n",
              "G42 D1 G1 X0 Y0 F300\nX50\nX55 Y30\nX-3 Y39\nG40 X-30\n"},
        Twins{"ArcsAboutAPole",
              "L X+0 Y+20 RL F300\nCC X+30 Y+20\nC X+60 DR-\nCC IX-20 IY+0\nC X+20 DR-\n"
              "L Y+60\nL X-30 R0\n",
              "G41 D1 G1 X0 Y20 F300\nG2 X60 I30 J0\nG2 X20 Y20 I-20 J0\nG1 Y60\nG40 X-30\n"},
        Twins{"ArcsOfARadius",
              "L X+0 Y+20 RL F300\nCR X+20 Y+40 R+20 DR-\nCR X+40 Y+20 R-20 DR-\nL Y-20\n"
              "L X-30 R0\n",
              "G41 D1 G1 X0 Y20 F300\nG2 X20 Y40 R20\nG2 X40 Y20 R-20\nG1 Y-20\nG40 X-30\n"},
        Twins{"ArcsThatTouch",
              "L X+0 Y+0 RL F300\nL Y+40\nCT X+30 Y+70\nCT X+60 Y+40\nL Y+0\nL X-30 Y-30 R0\n",
              "G41 D1 G1 X0 Y0 F300\nY40\nG2 X30 Y70 I30 J0\nG2 X60 Y40 I0 J-30\nG1 Y0\n"
              "G40 X-30 Y-30\n"},
        Twins{"PolarWords",
              "CC X+50 Y+50\nLP PR+40 PA+180 RL F300\nCP PA+90 DR-\nCP IPA-90 DR-\nLP PR+50 PA+0\n"
              "LP IPR+5 IPA-30\nL X-30 Y-30 R0\n",
              "G41 D1 G1 X10 Y50 F300\nG2 X50 Y90 I40 J0\nG2 X90 Y50 I0 J-40\nG1 X100 Y50\n"
              "X97.63139720814412 Y22.5\nG40 X-30 Y-30\n"},
        Twins{"Helix",
              "L Z+0 FMAX\nL X+70 Y+50 RL F300\nCC X+50 Y+50\nCP IPA+720 IZ-4 DR+\nL Y+80\nL X-30 "
              "R0\n",
              "G0 Z0\nG41 D1 G1 X70 Y50 F300\nG3 X70 Y50 Z-2 I-20 J0\nG3 X70 Y50 Z-4 I-20 J0\nG1 "
              "Y80\n"
              "G40 X-30\n"},
        Twins{"Corners",
              "L X+0 Y+0 RL F300\nL Y+50\nRND R8 F90\nL X+70\nCHF 6\nL Y+0\nL X-30 Y-30 R0\n",
              "G41 D1 G1 X0 Y0 F300\nY42\nG2 X8 Y50 R8 F90\nG1 X64 F300\nX70 Y44\nY0\n"
              "G40 X-30 Y-30\n"},
        // Half of an octagon's angle: tan(22.5) of the radius is what either line loses.
        Twins{"ObtuseCorner",
              "L X+0 Y+0 RL F300\nL Y+50\nRND R8\nL IX+40 IY+40\nL X+90\nL X-30 Y-30 R0\n",
              "G41 D1 G1 X0 Y0 F300\nY46.68629150101524\n"
              "G2 X2.3431457505076194 Y52.34314575050762 I8 J0\nG1 X40 Y90\nX90\n"
              "G40 X-30 Y-30\n"},
        // LEN and R count on the path of the tool, which is the contour plus 4 mm.
        Twins{"TangentLeads",
              "APPR LT X+0 Y+0 LEN10 RL F300\nL Y+50\nDEP LT LEN7 F200\nL X-30 FMAX\n",
              "G41 D1 G0 X0 Y-10\nG1 Y0 F300\nY50\nG40 X-4 Y57 F200\nG0 X-30\n"},
        Twins{"LeadsAcross",
              "L X-29 Y-29 F700\nAPPR LN X+0 Y+0 LEN10 RL F300\nL Y+50\nDEP LN LEN7\nL X-30 FMAX\n",
              "G1 X-29 Y-29 F700\nX-14 Y0\nG41 D1 X0 Y0 F300\nY50\nG40 X-11\nG0 X-30\n"},
        Twins{"RoundLeads",
              "L X-29 Y-29 F700\nAPPR CT X+0 Y+0 CCA90 R+10 RL F300\nL Y+50\nDEP CT CCA90 R+6\n"
              "L X-30 FMAX\n",
              "G1 X-29 Y-29 F700\nG41 D1 X-14 Y-14\nG3 X0 Y0 I0 J14 F300\nG1 Y50\n"
              "G3 X-10 Y60 I-10 J0\nG40 G1 X-10 Y56\nG0 X-30\n"},
        Twins{"RoundLeadsOnTheRight",
              "L X-29 Y-29 F700\nAPPR CT X+0 Y+0 CCA90 R+10 RR F300\nL Y+50\nDEP CT CCA90 R+6\n"
              "L X-30 FMAX\n",
              "G1 X-29 Y-29 F700\nG42 D1 X14 Y-14\nG2 X0 Y0 I0 J14 F300\nG1 Y50\n"
              "G2 X10 Y60 I10 J0\nG40 G1 X10 Y56\nG0 X-30\n"},
        // From straight below the circle about (-16, 0): 3-4-5.
        Twins{"RoundAndStraightLeads",
              "L X-36 Y+0 F700\nAPPR LCT X+0 Y+0 R12 RL F300\nL Y+50\nDEP LCT X-36 Y+50 R12\n",
              "G1 X-36 Y0 F700\nG41 D1 X-25.6 Y-12.8 F300\nG3 X0 Y0 I9.6 J12.8\nG1 Y50\n"
              "G3 X-25.6 Y62.8 I-16 J0\nG40 G1 X-36 Y50\n"},
        // D-86
        Twins{"RoundAndStraightLeadsAfterFmax",
              "L X-36 Y+0 FMAX\nAPPR LCT X+0 Y+0 R12 RL F300\nL Y+50\nDEP LCT X-36 Y+50 R12\n",
              "G0 X-36 Y0\nG41 D1 G1 X-25.6 Y-12.8 F300\nG3 X0 Y0 I9.6 J12.8\nG1 Y50\n"
              "G3 X-25.6 Y62.8 I-16 J0\nG40 G1 X-36 Y50\n"},
        Twins{"NoRadius", "L X+0 Y+0 RL F300\nL Y+50\nL X-30 R0\n",
              "G41 D1 G1 X0 Y0 F300\nY50\nG40 X-30\n", 0.5}),
    [](const auto& tested) { return tested.param.name; });

TEST(Klartext, CountsFeedsOfAnInchInTenths) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 2.54;
  setup.session.program.mode.selection = Selection::direct;
  const std::string text =
      "BEGIN PGM Z INCH\nTOOL CALL 1 Z\nL X-1 Y-1 R0 FMAX\nL X+0 Y+0 RL F80\nL Y+2\nRND R0.5 F40\n"
      "L X+3\nL Y+4 R0\nEND PGM Z INCH\n";
  const auto path = moving(to_blocks(text, setup).blocks, 1e-6);
  ASSERT_EQ(path.size(), 6u);
  EXPECT_NEAR(path[2].feed, 203.2, 1e-9);
  EXPECT_NEAR(path[3].feed, 101.6, 1e-9);
  EXPECT_NEAR(end_of(path[3].path).y(), 53.34, 1e-6);
  const std::string written = to_text(text, setup).text;
  EXPECT_NE(written.find("DR- F40\n"), std::string::npos) << written;
  EXPECT_NE(written.find("X+3 Y+2.1 F80\n"), std::string::npos) << written;
}

// An arc of the output has its centre in a CC of its own. What the program counts on its pole for
// gets it back.
TEST(Klartext, GivesBackThePoleThatArcsOfTheOutputHaveMoved) {  // D-131
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 2;
  setup.session.program.mode.selection = Selection::direct;
  setup.session.program.mode.transition = Transition::circular;
  const std::string text =
      "1 BEGIN PGM P MM\n2 TOOL CALL 1 Z\n3 CC X+7 Y+8\n4 L X-9 Y-9 R0 FMAX\n5 L X+0 Y+0 RL F80\n"
      "6 L Y+20\n7 L X+30\n8 L Y+50 R0\n9 L X+7 Y+18\n10 C X+7 Y-2 DR+\n11 CP PA+90 DR+\n"
      "12 END PGM P MM\n";
  const std::string written = to_text(text, setup).text;
  EXPECT_NE(written.find("9 L X+7 Y+18\nCC X+7 Y+8\n10 C X+7 Y-2 DR+\n11 CP PA+90 DR+\n"),
            std::string::npos)
      << written;
}

// What a label or another program counts on is the pole of the program, not that of the last arc
// of the output; and after a call only the control knows where the pole is.
TEST(Klartext, HandsThePoleOfTheProgramToWhatItCalls) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 2;
  setup.session.program.mode.selection = Selection::direct;
  setup.session.program.mode.transition = Transition::circular;
  const std::string contour = "L X-9 Y-9 R0 FMAX\nL X+0 Y+0 RL F80\nL Y+20\nL X+30\nL Y+50 R0\n";
  const std::string label = "LBL 1\nLP PR+5 PA+90\nLBL 0\n";
  const std::string call = "CALL LBL 1\n";
  const std::string written =
      to_text("BEGIN PGM P MM\nTOOL CALL 1 Z\nCC X+7 Y+8\n" + contour + label + contour + call +
                  contour + "CC X+0 Y+20\nLP PR+5 PA+0\nEND PGM P MM\n",
              setup)
          .text;
  EXPECT_NE(written.find("CC X+7 Y+8\n" + label), std::string::npos) << written;
  EXPECT_NE(written.find("CC X+7 Y+8\n" + call), std::string::npos) << written;
  std::size_t poles = 0;
  for (const std::string& line : lines_of(written)) poles += line == "CC X+0 Y+20" ? 1 : 0;
  EXPECT_EQ(poles, 4u) << written;
}

// Of a line in which a side stands alone nothing is left, and of one with its feed the feed.
TEST(Klartext, LeavesNoBlockOfASideAlone) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  setup.session.program.mode.tool_radius = 5;
  setup.session.program.mode.selection = Selection::direct;
  const std::string text =
      "BEGIN PGM P MM\nTOOL CALL 1 Z\nL X-20 Y+0 R0 FMAX\nL RL F500\nL X+0 Y+0\nL Y+50\n"
      "L R0 FMAX\nL X-20 F90\nL RL\nL X+0\nL Y+0\nL R0 M5\nL X-20\nEND PGM P MM\n";
  EXPECT_EQ(to_text(text, setup).text,
            "BEGIN PGM P MM\nTOOL CALL 1 Z\nL X-20 Y+0 R0 FMAX\nL F500\nL X-5 Y+0\nL X-5 Y+50\n"
            "L X-20 Y+50 F90\nL X+5 Y+50\nL X+5 Y+0\nL M5\nL X-20 Y+0\nEND PGM P MM\n");
}

TEST(Klartext, LeavesTheSideOfATextAndOfAComment) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::heidenhain;
  const std::string text =
      "0 BEGIN PGM RL MM\n1 TOOL CALL \"RL 5\" Z S3 ; RL\n2 L X+1 Y+2 R0 FMAX ; RR \xE4\n"
      "/3 L X+3\n4 L X+2 Y+2 M99\n* RL\n5 M8\n6 L A+30 C-5 F90\n7 STOP M5\n8 ; DEP ~~~\n"
      "9 END PGM RL MM\n";
  const ProgramRun written = to_text(text, setup);
  EXPECT_FALSE(written.stopped) << written.report();
  EXPECT_EQ(written.text, text);
}

// After G40 alone the tool still stands beside the contour: to go where the contour ends in the
// program is a motion, 4 mm here.
TEST(ABareG40, LetsTheToolGoBackToWhereItEndedInTheProgram) {  // D-123
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::linuxcnc;
  setup.session.program.mode.tool_radius = 4;
  setup.session.program.mode.selection = Selection::direct;
  const std::string pass = "G41 G1 X10. F100\nX50.\nG40\nG0 Z5.\nX50.\n";
  const ProgramRun written = to_blocks("G0 X0 Y0\n" + pass + "G0 X0\n" + pass + "M30\n", setup);
  ASSERT_FALSE(written.stopped) << written.report();
  const auto path = moving(written.blocks, 1e-3);
  ASSERT_EQ(path.size(), 7u);
  EXPECT_LT((start_of(path[2].path) - Point(50, 4)).norm(), 1e-9) << text_of(path[2]);
  EXPECT_LT((end_of(path[2].path) - Point(50, 0)).norm(), 1e-9) << text_of(path[2]);
  EXPECT_LT((start_of(path[3].path) - Point(50, 0)).norm(), 1e-9) << text_of(path[3]);
}

// FANUC keeps the offset over blocks without a distance in the plane: the next one that has one
// leads back.
TEST(ABareG40, OfFanucWaitsForAMotionThatHasALength) {  // D-123
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.tool_radius = 4;
  setup.session.program.mode.selection = Selection::direct;
  const std::string contour = "G90 G0 X-20. Y0\nG41 D1 G1 X0 F100\nY50.\n";
  for (const std::string end : {"G40\nG0 Z5.\n", "G40 X0\nG0 Z5.\n", "G91 G40 X0 Y0\nG90 G0 Z5.\n",
                                "G40\nG1 X0\nG0 Z5.\n", "G40 G1 X0 Z1.\nG0 Z5.\n"}) {
    const ProgramRun written = to_blocks(contour + end + "X-20.\nM30\n", setup);
    ASSERT_FALSE(written.stopped) << end << written.report();
    const auto path = moving(written.blocks, 1e-3);
    ASSERT_EQ(path.size(), 4u) << end << written.listing();
    EXPECT_LT((start_of(path[3].path) - Point(-4, 50)).norm(), 1e-9) << end << text_of(path[3]);
    EXPECT_LT((end_of(path[3].path) - Point(-20, 50)).norm(), 1e-9) << end << text_of(path[3]);
    const std::string text = to_text(contour + end + "X-20.\nM30\n", setup).text;
    EXPECT_EQ(text.find("X0", text.find("Y50")), std::string::npos) << text;
  }
  // As after a bare G40.
  const ProgramRun unended = to_blocks(contour + "G40 X0\nG0 Z5.\nM30\n", setup);
  ASSERT_FALSE(unended.diagnostics.empty());
  EXPECT_EQ(unended.diagnostics.front().code, Code::ended_while_active);
}

// Above the contour the tool goes to the programmed point; so it does where only the control knows
// where it stands.
TEST(ABareG40, OfFanucIsFollowedByARapidMotionAboveTheEndOfTheContour) {  // D-123
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  setup.session.program.mode.tool_radius = 4;
  setup.session.program.mode.selection = Selection::direct;
  const std::string contour = "G90 G0 X-20. Y0\nG41 D1 G1 X0 F100\nX50.\nY40.\nX-20.\nY0\nG40\n";
  const std::string next = "G41 G1 X0 Y0\nX50.\nG40 X60.\nM30\n";
  for (const std::string up : {"G0 Z5.\n", "G0 G91 G28 Z0\nG90\n", "G0\n"}) {
    const std::string back = up == "G0\n" ? "X-20. Y0 Z5.\n" : "X-20. Y0\n";
    const ProgramRun written = to_text(contour + up + back + next, setup);
    EXPECT_FALSE(written.stopped) << up << written.report();
    EXPECT_NE(written.text.find("G00 X-20. Y0."), std::string::npos) << written.text;
  }
  for (const std::string lost : {"G28 X-20. Y0\n", "G91 G28 Y0\nG90\n", "G53 X0 Y0\n", "G55\n"}) {
    const std::string text = contour + lost + "G1 X-20. Y0\nZ-5.\nM30\n";
    const ProgramRun written = to_text(text, setup);
    EXPECT_FALSE(written.stopped) << lost << written.report();
    EXPECT_NE(written.text.find("G01 X-20. Y0."), std::string::npos) << lost << written.text;
  }
}

// L beside G41.1 is the orientation of a turning tool, and 0 that of a mill.
TEST(Linuxcnc, TakesAMillByItsOrientation) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::linuxcnc;
  const auto program = [](const std::string& orientation) {
    return "G21\nG0 X-20 Y-20\nG41.1 D10 " + orientation + "G1 X0 Y0 F200\nY50\nG40 X-20\nM2\n";
  };
  const ProgramRun mill = to_text(program("L0 "), setup);
  EXPECT_FALSE(mill.stopped) << mill.report();
  EXPECT_EQ(mill.text, to_text(program(""), setup).text);
  const ProgramRun turning = to_text(program("L2 "), setup);
  ASSERT_TRUE(turning.stopped);
  EXPECT_NE(turning.report().find("orientation of a turning tool"), std::string::npos)
      << turning.report();
}

TEST(UnknownFunctions, AreCopiedWhereTheSetupSaysSo) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  EXPECT_TRUE(to_text("G0 X1 Y1\nG777 X5 Q3\nM30\n", setup).stopped);
  setup.session.program.copies_unknown_words = true;
  const std::string text = "G0 X1 Y1\nG777 X5 Q3\nG0 X2 Y2\nM30\n";
  EXPECT_EQ(to_text(text, setup).text, text);
  setup.session.program.dialect = DialectName::sinumerik;
  const std::string names = "G0 X1 Y1\nMPEROF\nTOOL_CHECK(1,2)\nG0 X2 Y2\nM30\n";
  EXPECT_EQ(to_text(names, setup).text, names);
  setup.session.program.copies_unknown_words = false;
  EXPECT_TRUE(to_text(names, setup).stopped);
}

}  // namespace
}  // namespace trc::support
