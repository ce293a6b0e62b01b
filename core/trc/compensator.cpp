#include "core/trc/compensator.h"

#include "core/trc/compensator_passes.h"

namespace trc {

// clang-format off
bool Compensator::Passes::find_path(Input input) {
  return advance(relevant_blocks,    programmed,  path.blocks, input, checkpoint)
      && apply  (convert_circles,    path.blocks)
      && advance(rounded_input,      path,        input, checkpoint)
      && advance(kerf_masking,       path,        input, checkpoint)
      && apply  (offset,             path.blocks)
      && advance(inside_corner,      path,        input, checkpoint)
      && advance(contour_masking,    path,        input, checkpoint)
      && advance(transitions,        path,        input, checkpoint)
      && advance(loop_removal,       path,        input, checkpoint);
}

bool Compensator::Passes::finish_path(Input input, std::vector<CompensatedBlock>& out) {
  return apply  (contour_violations, path.blocks)
      && advance(bottlenecks,        path,        input, checkpoint)
      && advance(split,              path,        input, checkpoint)
      && advance(reporting,          path.blocks, out,   input, checkpoint);
}
// clang-format on

bool Compensator::Passes::step(Input input, std::vector<CompensatedBlock>& out) {
  if (diagnostics.stopped() || !find_path(input)) return false;
  unfinished = input;
  return go_on(out);
}

bool Compensator::Passes::go_on(std::vector<CompensatedBlock>& out) {
  while (loop_removal.is_leaving()) {
    if (!release(out)) return false;
    if (out.size() >= blocks_per_portion) return true;
  }
  const Input input = *unfinished;
  unfinished.reset();
  return finish_path(input, out);
}

Compensator::Compensator(const CompensatorSetup& setup, Diagnostics& diagnostics)
    : passes_(std::make_unique<Passes>(setup, diagnostics)) {}

Compensator::~Compensator() = default;

// Blocks go the short way, or one at a time through all passes: the order of diagnostics and the
// output before a stop must not depend on how the caller batches.
bool Compensator::feed(std::vector<Block>& blocks, std::vector<CompensatedBlock>& out) {
  std::span<Block> left(blocks);
  while (!left.empty() && !passes_->diagnostics.stopped()) {
    left = left.subspan(take(left, out));
    while (is_releasing()) release(out);
  }
  blocks.clear();
  return !passes_->diagnostics.stopped();
}

std::size_t Compensator::feed_until_report(std::span<Block> blocks,
                                           std::vector<CompensatedBlock>& out) {
  const std::vector<Diagnostic>& reports = passes_->diagnostics.pending();
  std::size_t taken = 0;
  while (taken < blocks.size() && !passes_->diagnostics.stopped()) {
    const bool reported = !reports.empty();
    const bool line_is_over = taken > 0 && index_of(blocks[taken]) != index_of(blocks[taken - 1]);
    if ((reported && line_is_over) || is_releasing()) return taken;
    taken += take(blocks.subspan(taken, reported ? 1 : blocks.size() - taken), out);
  }
  return blocks.size();
}

std::size_t Compensator::take(std::span<Block> blocks, std::vector<CompensatedBlock>& out) {
  Summary& summary = passes_->reporting.summary();
  if (const std::size_t count = passes_->run(blocks, out); count > 0) {
    summary.blocks_in += count;
    return count;
  }
  ++summary.blocks_in;
  passes_->programmed = blocks.first(1);
  if (!passes_->step(Input::more, out)) passes_->help_with_entry();
  passes_->programmed = {};
  return 1;
}

bool Compensator::finish(const TrcMode& at_end, std::vector<CompensatedBlock>& out) {
  bool goes_on = finish_until_portion(at_end, out);
  while (is_releasing()) goes_on = release(out);
  return goes_on;
}

bool Compensator::finish_until_portion(const TrcMode& at_end, std::vector<CompensatedBlock>& out) {
  passes_->relevant_blocks.end_in(at_end);
  if (passes_->step(Input::ended, out)) return true;
  passes_->help_with_entry();
  return false;
}

bool Compensator::is_releasing() const {
  return passes_->unfinished && !passes_->diagnostics.stopped();
}

bool Compensator::release(std::vector<CompensatedBlock>& out) {
  if (passes_->go_on(out)) return true;
  passes_->help_with_entry();
  return false;
}

void Compensator::save(StateWriter& archive) const { archive(*passes_); }
void Compensator::load(StateReader& archive) { archive(*passes_); }

const Summary& Compensator::summary() const { return passes_->reporting.summary(); }

}  // namespace trc
