#include "core/survey/program_reading.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "core/nc/dialect/dialect.h"

namespace trc::survey {

Reader text_reader(std::string_view text, const ReaderLimits& limits,
                   Checkpoint::Interrupt interrupt) {
  return [text, limits, interrupt = std::move(interrupt)](ProgramState& state, Diagnostics& log) {
    constexpr std::size_t bytes_per_piece = ProgramReader::bytes_between_questions;
    ProgramReader program(limits, state, log, interrupt);
    std::vector<LinePointer> lines;
    const auto recycle = [&] {
      for (LinePointer& line : lines) program.recycle(std::move(line));
      lines.clear();
    };
    for (std::size_t at = 0; at < text.size(); at += bytes_per_piece) {
      if (interrupt) interrupt();
      const bool goes_on = program.feed(text.substr(at, bytes_per_piece), lines);
      recycle();
      if (!goes_on) return;
    }
    while (program.resolve(lines)) recycle();
    program.finish(lines);
  };
}

ProgramReading read_with(double radius, const SessionSetup& session, const Reader& reader) {
  ProgramReading reading{.radius = radius};
  ProgramSetup setup = program_setup(session);
  setup.every_radius = radius;
  Diagnostics log;
  log.speak(session.language, dialect_of(session.program.dialect).words);
  ProgramState state(setup, session.compensator.tolerances, log, reading.blocks);
  reader(state, log);
  reading.uses = state.radius_uses();
  reading.at_end = state.mode();
  reading.use_at_end = state.radius_use();
  reading.moves_by_radius = state.moves_by_radius();
  reading.refused = log.stopped();
  reading.diagnostics = log.take();
  reading.places = log.places();
  return reading;
}

ChangedModes::ChangedModes(const ProgramReading& reading, const ModeChange& change)
    : change_(change), at_end_(changed(reading.at_end, reading.use_at_end, reading.radius)) {
  modes_.reserve(reading.uses.size());
  for (const RadiusUse& use : reading.uses)
    modes_.emplace(use.mode.get(),
                   std::make_shared<const TrcMode>(changed(*use.mode, use, reading.radius)));
}

TrcMode ChangedModes::changed(TrcMode mode, const RadiusUse& use, double read_with) const {
  RadiusTerms terms = use.terms;
  // The length that the program adds to its radius stays.
  if (terms.nominal > 0)
    terms.radius = change_.radius + (terms.radius - read_with);
  else
    terms.radius =
        std::copysign(change_.radius + (std::abs(terms.radius) - read_with), terms.radius);
  give_radius(terms, use.side, mode);
  if (change_.removes_loops) {
    mode.masking = Masking::on;
    mode.options.remove_masked_blocks = true;
  }
  return mode;
}

void ChangedModes::change(const Block& block, Block& result) {
  result = block;
  std::visit(
      [&](auto& given) {
        if (given.mode.get() != last_) {
          last_ = given.mode.get();
          changed_last_ = modes_.at(last_);
        }
        given.mode = changed_last_;
      },
      result);
}

}  // namespace trc::survey
