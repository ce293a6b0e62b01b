#include "client/cli/program_info.h"

#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>
#include <variant>

#include "core/geometry/segment.h"
#include "core/nc/dialect/dialect.h"

namespace trc::cli {
namespace {

// The dialect most lines look like that look like one.
std::optional<DialectName> suggestion(const std::string& program) {
  std::array<std::size_t, 5> votes{};
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);)
    if (const auto name = looks_like(line)) ++votes[static_cast<std::size_t>(*name)];
  std::size_t most = 0;
  for (std::size_t name = 0; name < votes.size(); ++name)
    if (votes[name] > votes[most]) most = name;
  if (votes[most] == 0) return {};
  // What only LinuxCNC, Sinumerik or Heidenhain have decides against words that many have.
  for (const DialectName own :
       {DialectName::heidenhain, DialectName::sinumerik, DialectName::linuxcnc})
    if (votes[static_cast<std::size_t>(own)] > 0) return own;
  return static_cast<DialectName>(most);
}

struct Contours {
  std::size_t selections = 0;
  std::size_t blocks = 0;
  double length = 0;  // mm, of the compensated contour
};

Contours contours_of(const std::vector<CompensatedBlock>& blocks) {
  Contours found;
  bool selected = false;
  for (const CompensatedBlock& block : blocks) {
    const bool of_contour =
        block.origin != Origin::uncompensated && block.origin != Origin::passthrough;
    if (block.origin == Origin::uncompensated) selected = false;
    if (!of_contour) continue;
    if (!std::exchange(selected, true)) ++found.selections;
    ++found.blocks;
    found.length += length_of(block.path);
  }
  return found;
}

std::string rounded(double value) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << value;
  return text.str();
}

}  // namespace

ProgramInfo describe_program(const std::string& program, ProgramSessionSetup setup) {
  ProgramInfo info;
  std::ostringstream text;
  const Dialect& declared = dialect_of(setup.session.program.dialect);
  text << "dialect: " << declared.spelling;
  if (const auto other = suggestion(program); other && *other != declared.name)
    text << ", but it looks like " << dialect_of(*other).spelling;
  text << "\nunit at the start: " << (setup.session.program.inch ? "inch" : "mm") << '\n';

  setup.nc_text = false;
  ProgramSession session(setup);
  Answers answers;
  if (session.feed(program, answers)) session.finish(answers);
  const Answer whole = answers.take();
  info.refused = session.diagnostics().stopped();
  const Contours contours = contours_of(whole.blocks);
  text << "lines: " << session.lines_read() << '\n';
  if (session.is_computing())
    text << "computes: yes, " << session.executed_lines() << " lines executed\n";
  text << "selections: " << contours.selections << ", " << contours.blocks << " blocks, "
       << rounded(contours.length) << " mm\n";
  const std::vector<Diagnostic>& found = whole.diagnostics;
  text << (info.refused ? "refused:\n" : found.empty() ? "nothing to refuse\n" : "to look at:\n");
  for (const Diagnostic& diagnostic : found)
    text << "  line " << diagnostic.source.line << ": " << static_cast<int>(diagnostic.code) << ' '
         << message_of(diagnostic, diagnostic.language) << " ("
         << help_of(diagnostic, diagnostic.language) << ")\n";
  info.text = text.str();
  return info;
}

}  // namespace trc::cli
