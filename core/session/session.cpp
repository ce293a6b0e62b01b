#include "core/session/session.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/trc/state_archive.h"

namespace trc {
namespace {

// The tool and the program start in one place: the one the program names.
CompensatorSetup compensator_setup(const SessionSetup& setup) {
  CompensatorSetup result = setup.compensator;
  result.start = setup.program.start;
  return result;
}

}  // namespace

ProgramSetup program_setup(const SessionSetup& setup) {
  ProgramSetup result = setup.program;
  result.masking_switches_kerf = !setup.compensator.circular_kerf_masking;
  return result;
}

PathSession::PathSession(const SessionSetup& setup)
    : program_(program_setup(setup), setup.compensator.tolerances, read_diagnostics_, blocks_),
      compensator_(compensator_setup(setup), setup.verify, diagnostics_) {
  diagnostics_.speak(setup.language);
}

bool PathSession::advance(ProgramOutput& out) {
  placed_ = diagnostics_.pending().size();
  std::span<Block> left(blocks_);
  for (Diagnostic& found : read_diagnostics_.take()) {
    const std::uint64_t index = found.source.index;
    compensate_before(index, left, out);
    // Where nothing is selected, all that was given before an error is certain.
    if (found.severity == Severity::error && !program_.contour_open() && !diagnostics_.stopped())
      compensator_.finish(program_.mode(), out.blocks);
    if (!diagnostics_.report(std::move(found))) break;
    compensate_before(index + 1, left, out);
    place(out);
  }
  compensate_before(std::numeric_limits<std::uint64_t>::max(), left, out);
  place(out);
  blocks_.clear();
  return !diagnostics_.stopped();
}

bool PathSession::advance(std::vector<CompensatedBlock>& out) {
  output_.blocks.swap(out);
  const bool goes_on = advance(output_);
  output_.blocks.swap(out);
  output_.places.clear();
  return goes_on;
}

void PathSession::compensate_before(std::uint64_t index, std::span<Block>& left,
                                    ProgramOutput& out) {
  while (!diagnostics_.stopped() && !left.empty() && index_of(left.front()) < index) {
    const auto behind = std::partition_point(
        left.begin(), left.end(), [&](const Block& block) { return index_of(block) < index; });
    const auto due = left.first(static_cast<std::size_t>(behind - left.begin()));
    left = left.subspan(compensator_.feed_until_report(due, out.blocks));
    place(out);
  }
}

void PathSession::place(ProgramOutput& out) {
  const std::size_t reports = diagnostics_.pending().size();
  if (reports == placed_) return;
  out.places.push_back({.blocks = out.blocks_before + out.blocks.size(),
                        .bytes = out.text.size(),
                        .diagnostics = reports});
  placed_ = reports;
}

Diagnostics& PathSession::diagnostics() {
  for (Diagnostic& found : read_diagnostics_.take()) diagnostics_.report(std::move(found));
  return diagnostics_;
}

void PathSession::save(StateWriter& archive) const {
  archive(diagnostics_, program_, compensator_);
}
void PathSession::load(StateReader& archive) { archive(diagnostics_, program_, compensator_); }

bool PathSession::finish(const Source& end, std::vector<CompensatedBlock>& out) {
  program_.end(end);
  return advance(out) && compensator_.finish(program_.mode(), out);
}

}  // namespace trc
