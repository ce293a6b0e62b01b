#include "client/cli/program_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>
#include <variant>

#include "client/cli/fixed_text.h"
#include "client/cli/passed_words.h"
#include "client/cli/reporter.h"
#include "client/cli/speech.h"
#include "core/base/length_unit.h"
#include "core/geometry/segment.h"
#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/text/characters.h"
#include "core/session/contour_reader.h"

namespace trc::cli {
namespace {

bool begins_with(std::string_view line, std::string_view beginning) {
  return in_upper_case(line.substr(0, beginning.size())) == beginning;
}

// The dialect of a line that no other one has: the head of a program of Sinumerik, a cycle of ISG.
std::optional<DialectName> certainly(std::string_view line) {
  line = without_blanks_in_front(line);
  if (begins_with(line, "%_N_") || begins_with(line, ";$PATH=")) return DialectName::sinumerik;
  if (begins_with(line, "N"))
    line = without_blanks_in_front(
        line.substr(std::min(line.find_first_not_of("0123456789", 1), line.size())));
  if (begins_with(line, "L CYCLE [") || begins_with(line, "L CYCLE[")) return DialectName::isg;
  return {};
}

// The dialect that most lines look like; none: no line looks like any.
std::optional<DialectName> suggestion(const std::string& program) {
  std::array<std::size_t, 5> votes{};
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    if (is_of_okuma(line)) return {};
    if (const auto name = certainly(line)) return name;
    if (const auto name = looks_like(line)) ++votes[static_cast<std::size_t>(*name)];
  }
  std::size_t most = 0;
  for (std::size_t name = 0; name < votes.size(); ++name)
    if (votes[name] > votes[most]) most = name;
  if (votes[most] == 0) return {};
  // A word that only LinuxCNC, Sinumerik or Heidenhain has outweighs words that several have.
  for (const DialectName own :
       {DialectName::heidenhain, DialectName::sinumerik, DialectName::linuxcnc})
    if (votes[static_cast<std::size_t>(own)] > 0) return own;
  return static_cast<DialectName>(most);
}

bool is_written_in_din_iso(const std::string& program) {
  std::size_t blocks = 0;
  std::size_t others = 0;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos)
      ++(is_heidenhain_iso(line.substr(0, line.find('\r'))) ? blocks : others);
  return blocks > others;
}

struct Contours {
  std::size_t selections = 0;
  std::size_t blocks = 0;
  double length = 0;  // mm, of the compensated contour
};

// A block without motion in the plane, such as a lift within a contour, ends no selection.
Contours contours_of(const std::vector<CompensatedBlock>& blocks) {
  Contours found;
  Origin last = Origin::uncompensated;
  for (const CompensatedBlock& block : blocks) {
    if (block.origin == Origin::uncompensated || block.origin == Origin::passthrough) continue;
    const bool has_left = last == Origin::retract || last == Origin::uncompensated;
    const bool begins = has_left ? block.origin != last
                                 : block.origin == Origin::approach && last != Origin::approach;
    if (begins) ++found.selections;
    last = block.origin;
    ++found.blocks;
    found.length += length_of(block.path);
  }
  return found;
}

// The diagnostic if the program is refused because these settings give no radius.
std::optional<Diagnostic> missing_radius(const std::string& program,
                                         const ProgramSessionSetup& setup) {
  ProgramSession session(setup);
  Answers answers;
  if (session.feed(program, answers)) session.finish(answers);
  const std::vector<Diagnostic> found = answers.take().diagnostics;
  const auto missing = std::ranges::find(found, Code::no_tool_radius, &Diagnostic::code);
  return missing == found.end() ? std::nullopt : std::optional(*missing);
}

// What lengths count in: at first, and with the lines from which on another unit holds.
struct Units {
  LengthUnit first = LengthUnit::mm;
  std::string told{};
};

Units units_of(const std::string& program, const SessionSetup& setup,
               const std::vector<CompensatedBlock>& blocks) {
  ContourReader reader(setup);
  reader.read(program, [](const std::vector<Block>&) { return true; });
  bool inch = reader.is_inch(blocks.empty() ? 0 : blocks.front().source.index);
  Units units{.first = inch ? LengthUnit::inch : LengthUnit::mm, .told = inch ? "inch" : "mm"};
  for (const CompensatedBlock& block : blocks) {
    if (reader.is_inch(block.source.index) == inch) continue;
    inch = !inch;
    units.told += (inch ? ", inch (" : ", mm (") + std::to_string(block.source.line) + ")";
  }
  return units;
}

// "T3 (4), T5 (20, 2x)": the line of the first one, and how many there are.
std::string list_of(const std::vector<CountedWord>& words) {
  constexpr std::size_t most = 30;
  std::string list;
  for (std::size_t index = 0; index < std::min(words.size(), most); ++index) {
    const CountedWord& word = words[index];
    list += (index == 0 ? "" : ", ") + word.text + " (" + std::to_string(word.line);
    list += (word.times == 1 ? "" : ", " + std::to_string(word.times) + "x") + ")";
  }
  return words.size() > most ? list + ", …" : list;
}

std::string dialect_of_program(const std::string& program, const Dialect& declared) {
  std::string dialect = "dialect: " + std::string(declared.spelling);
  if (is_written_in_din_iso(program))
    return dialect + ", but it is DIN/ISO of Heidenhain, which is not read";
  const auto other = suggestion(program);
  if (!other || *other == declared.name) return dialect;
  // What looks like Fanuc may as well be of LinuxCNC.
  if (*other == DialectName::fanuc && declared.name == DialectName::linuxcnc) return dialect;
  return dialect + ", but it looks like " + std::string(dialect_of(*other).spelling);
}

std::string lines_of(const std::string& program, std::uint64_t read) {
  const auto lines = static_cast<std::uint64_t>(std::ranges::count(program, '\n')) +
                     (program.empty() || program.ends_with('\n') ? 0 : 1);
  return "lines: " + std::to_string(lines) +
         (read < lines ? ", read up to " + std::to_string(read) : "");
}

// First the errors that refuse the program, then the findings to look at.
void tell_findings(std::vector<Diagnostic> found, bool refused, DialectName dialect,
                   std::ostream& text) {
  std::stable_partition(found.begin(), found.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::error;
  });
  std::string_view heading;
  for (const Diagnostic& diagnostic : found) {
    const bool refuses = refused && diagnostic.severity == Severity::error;
    const std::string_view own = refuses ? "refused:" : "to look at:";
    if (std::exchange(heading, own) != own) text << told(std::string(own)) << '\n';
    const DiagnosticTexts texts = texts_of(for_command_line(diagnostic, dialect));
    text << "  " << told("line " + std::to_string(diagnostic.source.line)) << ": "
         << static_cast<int>(diagnostic.code) << ' ' << texts.text << " (" << texts.help << ")\n";
  }
}

}  // namespace

ProgramInfo describe_program(const std::string& program, ProgramSessionSetup setup) {
  ProgramInfo info;
  std::ostringstream text;
  const Dialect& declared = dialect_of(setup.session.program.dialect);
  const auto say = [&text](const std::string& line) { text << told(line) << '\n'; };
  say(dialect_of_program(program, declared));

  setup.nc_text = false;
  // The description is about the contours of the program, whatever tool cuts them.
  ProgramSetup& asked = setup.session.program;
  const bool has_tools = !asked.tools.empty() || asked.tool_radius_given ||
                         asked.mode.tool_radius != 0 || asked.nominal_radius > 0;
  constexpr double hardly_any_radius = 1e-3;
  const auto missing = has_tools ? std::nullopt : missing_radius(program, setup);
  if (!has_tools) asked.every_radius = hardly_any_radius;
  ProgramSession session(setup);
  Answers answers;
  if (session.feed(program, answers)) session.finish(answers);
  const Answer whole = answers.take();
  info.refused = session.diagnostics().stopped();
  const Contours contours = contours_of(whole.blocks);
  const Units units = units_of(program, setup.session, whole.blocks);
  say("unit: " + units.told);
  say(lines_of(program, session.lines_read()));
  if (!has_tools) say("tools: none are given, so that nothing is said of what fits");
  const PassedWords words = passed_words(whole.blocks, declared.name);
  if (!words.tools.empty()) say("tools of the program (line): " + list_of(words.tools));
  // Of a refused program it is not known how many lines it would execute.
  const std::uint64_t executed = session.executed_lines();
  if (session.is_computing())
    say(info.refused ? "computes: yes"
                     : "computes: yes, " + std::to_string(executed) +
                           (executed == 1 ? " line executed" : " lines executed"));
  say(std::string(info.refused ? "selections before the fault: " : "selections: ") +
      std::to_string(contours.selections) + ", " + std::to_string(contours.blocks) + " blocks, " +
      fixed(contours.length / mm_of(units.first), 1) + name_of_unit(units.first));
  if (!words.passed.empty()) say("passed on (line): " + list_of(words.passed));
  std::vector<Diagnostic> found = whole.diagnostics;
  if (missing && !info.refused) found.insert(found.begin(), *missing);
  if (found.empty()) say("nothing to refuse");
  tell_findings(std::move(found), info.refused, declared.name, text);
  info.text = text.str();
  return info;
}

}  // namespace trc::cli
