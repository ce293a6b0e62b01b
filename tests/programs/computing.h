#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "core/session/program_session.h"
#include "tests/support/program_run.h"

// Programs that compute, for tests: each beside what a person would write in its place.

namespace trc::support {

struct Twin {
  std::string name{};
  std::string computed{};
  std::string flat{};
};

inline std::ostream& operator<<(std::ostream& out, const Twin& twin) { return out << twin.name; }

// With so many decimals that rounding does not show.
inline std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.9f", value);
  return text.data();
}
inline std::string word(char letter, double value) { return letter + number(value); }

inline double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
inline double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

// Blocks of a square about the origin at the height `z`; `select` selects TRC on the way to it.
inline std::string square(double size, double z, const std::string& select = "G41") {
  const std::string s = number(size / 2);
  return "G0 Z" + number(z) + "\n" + select + " G1 X-" + s + " Y-" + s + " F500\nY" + s + "\nX" +
         s + "\nY-" + s + "\nX-" + s + "\nG40 X0 Y-40\n";
}

// A program that goes round a regular polygon clockwise, from its corner on the X axis.
inline std::string polygon(int corners, double radius, const std::string& select = "G42") {
  std::string text = "G90 G0 X60 Y0\n" + select + " G1 X" + number(radius) + " Y0 F400\n";
  for (int corner = 1; corner <= corners; ++corner) {
    const double angle = -360.0 / corners * corner;
    text += "X" + number(radius * cosine(angle)) + " Y" + number(radius * sine(angle)) + "\n";
  }
  return text + "G40 X60 Y0\nM30\n";
}

inline ProgramSessionSetup computing_setup(DialectName name, double tool_radius = 2) {
  ProgramSessionSetup setup;
  const Dialect& dialect = dialect_of(name);
  setup.session.program.dialect = name;
  setup.session.program.decimals = 8;
  dialect.begin(setup.session.program.mode);
  setup.session.program.mode.tool_radius = tool_radius;
  setup.session.compensator.limits.passive_blocks = 10'000;
  return setup;
}

// With the tool 1.
inline ProgramSessionSetup setup_with_tool(DialectName name, double tool_radius = 2) {
  ProgramSessionSetup setup = computing_setup(name, tool_radius);
  setup.session.program.tools = {{1, ToolRow(tool_radius)}};
  return setup;
}

// The flat program: the output of a program in which nothing is compensated.
inline std::string flat_of(const std::string& text, const ProgramSessionSetup& setup) {
  const ProgramRun ran = to_text(text, setup);
  return ran.stopped ? ran.report() : ran.text;
}

// Code and line of the first error that stops the program; 0 and 0: none does.
inline std::pair<int, unsigned> refusal_of(const std::string& text,
                                           const ProgramSessionSetup& setup) {
  const ProgramRun ran = to_text(text, setup, 0, German::as_it_is);
  if (!ran.stopped || ran.diagnostics.empty()) return {};
  const auto first = std::ranges::find(ran.diagnostics, Severity::error, &Diagnostic::severity);
  return {static_cast<int>(first->code), first->source.line};
}

}  // namespace trc::support
