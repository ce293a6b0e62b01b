#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/archive.h"
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
  return out << static_cast<int>(placed.code) << " of line " << placed.line << " after byte "
             << placed.bytes;
}

void append_places(const Answer& part, std::size_t& bytes, std::vector<Placed>& places) {
  bytes += part.text.size();
  for (const Diagnostic& told : part.diagnostics)
    places.push_back({told.code, told.source.line, bytes});
}

// `resumed`: each piece in a session of its own.
std::vector<Placed> places_of(std::string_view program, std::size_t cut,
                              const ProgramSessionSetup& setup = {}, bool resumed = false) {
  std::optional<ProgramSession> session(std::in_place, setup);
  std::vector<Placed> places;
  std::size_t bytes = 0;
  Answers out([&](const Answer& part) {
    append_places(part, bytes, places);
    return true;
  });
  for (std::size_t at = 0; at < program.size(); at += cut) {
    if (!session->feed(program.substr(at, cut), out)) break;
    if (!resumed) continue;
    std::stringstream state;
    {
      StateWriter archive(state);
      session->save(archive);
    }
    session.emplace(setup);
    StateReader archive(state);
    session->load(archive);
  }
  session->finish(out);
  return places;
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
  // A diagnostic comes after the whole text of its line.
  const std::vector<Placed> line_by_line = [&] {
    ProgramSession session({});
    Answers out;
    std::vector<Placed> places;
    std::size_t bytes = 0;
    std::string_view rest = program;
    const auto take = [&] { append_places(out.take(), bytes, places); };
    while (!rest.empty()) {
      const std::size_t length = rest.find('\n') + 1;
      const bool goes_on = session.feed(rest.substr(0, length), out);
      take();
      if (!goes_on) break;
      rest.remove_prefix(length);
    }
    session.finish(out);
    take();
    return places;
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

// A rounded corner waits for the motion after it; the centre of its arc is corrected, which the
// reader says at once.
TEST(DiagnosticPlaces, AreThoseOfTheLineWhereItWaitsForItsCorner) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  std::string program = "G90 G17 G0 X0 Y0\n";
  for (int i = 0; i < 40; ++i) {
    const std::string x = std::to_string(100 * i + 40);
    program += "G1 X" + std::to_string(100 * i + 20) + " Y0 F100\nG2 X" + x +
               " Y0 I10.02 J0,R2\n(waits)\nG1 X" + x + " Y30,C1\nX" + std::to_string(100 * i + 90) +
               "\n";
  }
  program += "M30\n";
  const std::vector<Placed> whole = places_of(program, program.size(), setup);
  EXPECT_EQ(whole.size(), 40U);
  for (const std::size_t cut : {1U, 13U, 200U}) {
    EXPECT_EQ(places_of(program, cut, setup), whole) << "cut every " << cut << " bytes";
    EXPECT_EQ(places_of(program, cut, setup, true), whole) << "resumed every " << cut << " bytes";
  }
}

}  // namespace
}  // namespace trc
