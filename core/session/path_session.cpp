#include "core/session/path_session.h"

#include <algorithm>
#include <iterator>

#include "core/nc/dialect/dialect.h"
#include "core/trc/state_archive.h"

namespace trc {
namespace {

// The tool starts where the program starts.
CompensatorSetup compensator_setup(const SessionSetup& setup) {
  CompensatorSetup result = setup.compensator;
  result.start = setup.program.start;
  return result;
}

std::uint64_t item_of(const Diagnostic& found) {
  return found.told_after.value_or(found.source.index);
}

}  // namespace

ProgramSetup program_setup(const SessionSetup& setup) {
  ProgramSetup result = setup.program;
  result.masking_switches_kerf = !setup.compensator.circular_kerf_masking;
  return result;
}

PathSession::PathSession(const SessionSetup& setup)
    : program_(program_setup(setup), setup.compensator.tolerances, found_, blocks_),
      compensator_(compensator_setup(setup), setup.verify, diagnostics_,
                   {.progress = setup.measuring}) {
  diagnostics_.speak(setup.language, dialect_of(setup.program.dialect).words);
  diagnostics_.count_as(found_.places());
}

bool PathSession::advance(Answers& out) { return advance_before(no_item, out); }

bool PathSession::advance_before(std::uint64_t index, Answers& out) {
  work_off(index, out);
  end_item(out);
  return goes_on(out);
}

bool PathSession::advance_through(std::uint64_t index, Answers& out) {
  open_item_ = index;
  work_off(index + 1, out);
  open_item_ = no_item;
  return out.hand_on() && !diagnostics_.stopped();
}

// Diagnostics of an item come together with those of its compensation, after all its blocks.
void PathSession::work_off(std::uint64_t end, Answers& out) {
  std::ranges::move(found_.take(), std::back_inserter(to_tell_));
  const std::uint64_t held_from = program_.held_from();
  // After an error no item comes that would complete the held ones.
  const std::uint64_t tell_before = found_.stopped() ? end : std::min(end, held_from);
  const std::uint64_t compensated_before = std::min(end, held_from);
  std::size_t told = 0;
  while (told < to_tell_.size() && item_of(to_tell_[told]) < tell_before) {
    Diagnostic& next = to_tell_[told++];
    const std::uint64_t item = item_of(next);
    compensate_before(std::min(item, compensated_before), out);
    // If no contour is open, all blocks given before an error are certain (D-144).
    if (next.severity == Severity::error && !program_.contour_open()) this->end(out);
    diagnostics_.report(std::move(next));
    // Errors that were found together are reported together.
    if (diagnostics_.stopped()) continue;
    compensate_before(std::min(item + 1, compensated_before), out);
    if (item != open_item_) out.tell(diagnostics_.take());
  }
  to_tell_.erase(to_tell_.begin(), to_tell_.begin() + static_cast<std::ptrdiff_t>(told));
  compensate_before(compensated_before, out);
  blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
}

void PathSession::compensate_before(std::uint64_t end, Answers& out) {
  while (goes_on(out) && next_ < blocks_.size() && index_of(blocks_[next_]) < end) {
    const std::span<Block> left = std::span(blocks_).subspan(next_);
    const auto behind = std::partition_point(
        left.begin(), left.end(), [&](const Block& block) { return index_of(block) < end; });
    const auto due = left.first(static_cast<std::size_t>(behind - left.begin()));
    const std::size_t count = compensator_.feed_until_report(due, out.blocks());
    next_ += count;
    release(out);
    const std::uint64_t item = index_of(due[count - 1]);
    const bool item_goes_on = count < due.size() && index_of(due[count]) == item;
    if (!item_goes_on && item != open_item_) out.tell(diagnostics_.take());
  }
}

void PathSession::release(Answers& out) {
  while (compensator_.is_releasing() && out.portion()) compensator_.release(out.blocks());
}

bool PathSession::end(Answers& out) {
  if (goes_on(out) && !std::exchange(ended_, true)) {
    compensator_.finish_until_portion(program_.mode(), out.blocks());
    release(out);
  }
  return out.hand_on() && !diagnostics_.stopped();
}

void PathSession::end_item(Answers& out) {
  out.tell(diagnostics_.take());
  out.hand_on();
}

bool PathSession::finish(const Source& end, Answers& out) {
  program_.end(end);
  if (advance(out)) this->end(out);
  return advance(out);
}

void PathSession::save(StateWriter& archive) const {
  archive(found_, diagnostics_, to_tell_, blocks_, ended_, program_, compensator_);
}

void PathSession::load(StateReader& archive) {
  archive(found_, diagnostics_, to_tell_, blocks_, ended_, program_, compensator_);
}

}  // namespace trc
