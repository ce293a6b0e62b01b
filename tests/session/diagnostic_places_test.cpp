#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/program_session.h"

namespace trc {
namespace {

struct Placed {
  Code code{};
  std::uint32_t line = 0;
  std::size_t bytes = 0;  // of the output before it

  bool operator==(const Placed&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Placed& placed) {
  return out << static_cast<int>(placed.code) << " of line " << placed.line << " behind byte "
             << placed.bytes;
}

std::vector<Placed> places_of(std::string_view program, std::size_t cut) {
  ProgramSession session({});
  ProgramOutput out;
  std::vector<Placed> result;
  const auto take = [&] {
    const std::vector<Diagnostic> diagnostics = session.diagnostics().take();
    std::size_t next = 0;
    out.places.push_back({.bytes = out.text.size(), .diagnostics = diagnostics.size()});
    for (const ProgramOutput::Place& place : out.places)
      for (; next < place.diagnostics; ++next)
        result.push_back({diagnostics[next].code, diagnostics[next].source.line, place.bytes});
    out.places.clear();
  };
  for (std::size_t at = 0; at < program.size(); at += cut) {
    if (!session.feed(program.substr(at, cut), out)) break;
    take();
  }
  session.finish(out);
  take();
  return result;
}

// A setting out of range, which the reader reports, then a step that is too short for the tool,
// which shows two blocks later; with technology in a line of its motion.
std::string program_with_warnings(std::string_view end) {
  std::string text =
      "G26 V.G.WZ_AKT.R=2\n#TRC [IGNORE_CONT_DAMAGE=1]\nG91 G41 G01 X10 F1000\nX10\n";
  for (int i = 0; i < 300; ++i) {
    text += "X20 M8\nY1\nX20\n";
    if (i % 5 == 0) text += "#TRC [STRETCH_FACTOR=30]\n";
    text += "M9\nY10 (up)\nX30\nY-5\n";
    if (i % 3 == 0) text += "#TRC [STRETCH_FACTOR=20]\n";
    if (i % 7 == 0) text += "X5\n#TRC [STRETCH_FACTOR=10]\nY0.5 M7\nX10\n";
  }
  return text.append(end);
}

void expect_same_places(const std::string& program) {
  const std::vector<Placed> line_by_line = [&] {
    ProgramSession session({});
    ProgramOutput out;
    std::vector<Placed> result;
    const auto take = [&] {
      for (const Diagnostic& diagnostic : session.diagnostics().take())
        result.push_back({diagnostic.code, diagnostic.source.line, out.text.size()});
    };
    std::string_view rest = program;
    while (!rest.empty()) {
      const std::size_t length = rest.find('\n') + 1;
      const bool goes_on = session.feed(rest.substr(0, length), out);
      take();
      if (!goes_on) break;
      rest.remove_prefix(length);
    }
    session.finish(out);
    take();
    return result;
  }();
  EXPECT_GT(line_by_line.size(), 300U);
  for (const std::size_t cut : {std::size_t{1}, std::size_t{13}, std::size_t{700}, program.size()})
    EXPECT_EQ(places_of(program, cut), line_by_line) << "cut every " << cut << " bytes";
}

TEST(DiagnosticPlaces, AreThoseOfTheLinesHoweverTheTextIsCut) {
  expect_same_places(program_with_warnings("G40 X50 Y-30\nM30\n"));
}

TEST(DiagnosticPlaces, AreKeptBeforeAnError) {
  expect_same_places(program_with_warnings("X10\nG77\nX10\n"));
}

TEST(DiagnosticPlaces, AreKeptWhereTheProgramEndsUnderCompensation) {
  expect_same_places(program_with_warnings("X10\nM30\n"));
}

}  // namespace
}  // namespace trc
