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

// Programs that compute, for tests: each beside what a person would write in its place.

namespace trc::support {

struct Twin {
  std::string name{};
  std::string computed{};
  std::string flat{};
};

inline std::ostream& operator<<(std::ostream& out, const Twin& twin) { return out << twin.name; }

// With as many decimals as leave nothing to be seen of rounding.
inline std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.9f", value);
  return text.data();
}
inline std::string word(char letter, double value) { return letter + number(value); }

inline double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
inline double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

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

struct Ran {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};
  bool stopped = false;

  [[nodiscard]] std::string report() const {
    std::string lines;
    for (const Diagnostic& found : diagnostics)
      lines += std::to_string(found.source.line) + ": " +
               std::to_string(static_cast<int>(found.code)) + ' ' + message_of(found) + '\n';
    return lines;
  }
};

enum class Output { nc_text, blocks };

// Fed in pieces of so many bytes; 0: as a whole.
inline Ran run_computing(const std::string& text, ProgramSessionSetup setup, Output output,
                         std::size_t piece = 0) {
  setup.nc_text = output == Output::nc_text;
  ProgramSession session(setup);
  Answers answers;
  bool running = true;
  const std::size_t step = piece == 0 ? text.size() + 1 : piece;
  for (std::size_t at = 0; running && at < text.size(); at += step)
    running = session.feed(std::string_view(text).substr(at, step), answers);
  if (running) session.finish(answers);
  Answer whole = answers.take();
  return {.text = std::move(whole.text),
          .blocks = std::move(whole.blocks),
          .diagnostics = std::move(whole.diagnostics),
          .stopped = session.diagnostics().stopped()};
}

// The program as it comes out where nothing is compensated: the flat one.
inline std::string flat_of(const std::string& text, const ProgramSessionSetup& setup) {
  const Ran ran = run_computing(text, setup, Output::nc_text);
  return ran.stopped ? ran.report() : ran.text;
}

// Code and line of what stops the program, of several the first; 0 where nothing does.
inline std::pair<int, unsigned> refusal_of(const std::string& text,
                                           const ProgramSessionSetup& setup) {
  const Ran ran = run_computing(text, setup, Output::nc_text);
  if (!ran.stopped || ran.diagnostics.empty()) return {};
  const auto first = std::ranges::find(ran.diagnostics, Severity::error, &Diagnostic::severity);
  return {static_cast<int>(first->code), first->source.line};
}

}  // namespace trc::support
