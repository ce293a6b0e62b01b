#include "core/trc/compensator.h"

#include "core/trc/clearance.h"
#include "core/trc/contour_masking.h"
#include "core/trc/contour_violations.h"
#include "core/trc/convert_circles.h"
#include "core/trc/kerf_masking.h"
#include "core/trc/loop_removal.h"
#include "core/trc/offset.h"
#include "core/trc/pass.h"
#include "core/trc/relevant_blocks.h"
#include "core/trc/reporting.h"
#include "core/trc/selection/inside_corner.h"
#include "core/trc/selection/split.h"
#include "core/trc/state_archive.h"
#include "core/trc/transitions.h"

namespace trc {
namespace {

std::uint64_t index_of(const Block& block) {
  return std::visit([](const auto& given) { return given.source.index; }, block);
}

}  // namespace

// The passes and the blocks on their way between them.
struct Compensator::Passes {
  Passes(const CompensatorSetup& setup, Diagnostics& log)
      : diagnostics(log),
        checkpoint(setup.interrupt),
        take_portion(setup.take_portion),
        relevant_blocks(setup, log),
        convert_circles(setup.tolerances),
        kerf_masking(setup.circular_kerf_masking, setup.tolerances),
        offset(setup.tolerances, log),
        inside_corner(setup.limits.selection_blocks, setup.tolerances, log, checkpoint),
        contour_masking(setup.limits.look_ahead_blocks, setup.limits.selection_blocks,
                        setup.tolerances, log, checkpoint),
        transitions(setup.tolerances, log),
        loop_removal(setup.limits.look_ahead_blocks, setup.limits.selection_blocks,
                     setup.tolerances, log, checkpoint),
        contour_violations(setup.tolerances, log),
        clearance(setup.implicit_contour_masking, setup.limits.look_ahead_blocks,
                  setup.limits.selection_blocks, setup.tolerances, log, checkpoint),
        reporting(setup, log) {}

  // clang-format off
  bool step(Input input, std::vector<CompensatedBlock>& out) {
    if (diagnostics.stopped() || !find_path(input)) return false;
    while (loop_removal.is_leaving()) {
      if (!loop_removal.let_go_some(path.blocks) || !finish_path(Input::more, out)) return false;
      if (out.size() < portion || !take_portion) continue;
      take_portion(out);
      if (diagnostics.stopped()) return false;  // by a verification of what it has taken
    }
    return finish_path(input, out);
  }
  bool find_path(Input input) {
    return advance(relevant_blocks,    programmed,  path.blocks, input, checkpoint)
        && apply  (convert_circles,    path.blocks)
        && advance(kerf_masking,       path,        input, checkpoint)
        && apply  (offset,             path.blocks)
        && advance(inside_corner,      path,        input, checkpoint)
        && advance(contour_masking,    path,        input, checkpoint)
        && advance(transitions,        path,        input, checkpoint)
        && advance(loop_removal,       path,        input, checkpoint);
  }
  bool finish_path(Input input, std::vector<CompensatedBlock>& out) {
    return apply  (contour_violations, path.blocks)
        && advance(clearance,          path,        input, checkpoint)
        && advance(split,              path,        input, checkpoint)
        && advance(reporting,          path.blocks, out,   input, checkpoint);
  }
  // clang-format on

  // The passes that hold something. Nothing lies between them when a call has ended.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(relevant_blocks, kerf_masking, inside_corner, contour_masking, transitions,
            loop_removal, clearance, reporting);
  }

  static constexpr std::size_t portion = 1024;

  Diagnostics& diagnostics;
  Checkpoint checkpoint;
  TakePortion take_portion;
  RelevantBlocks relevant_blocks;
  ConvertCircles convert_circles;
  KerfMasking kerf_masking;
  Offset offset;
  selection::InsideCorner inside_corner;
  ContourMasking contour_masking;
  Transitions transitions;
  LoopRemoval loop_removal;
  ContourViolations contour_violations;
  Clearance clearance;
  selection::Split split;
  Reporting reporting;

  std::span<Block> programmed;  // of the caller: one block
  OnTheWay<PathBlockPtr> path;
};

Compensator::Compensator(const CompensatorSetup& setup, Diagnostics& diagnostics)
    : passes_(std::make_unique<Passes>(setup, diagnostics)) {}

Compensator::~Compensator() = default;

// One block at a time through all passes: the order of diagnostics and what has
// come out before a stop must not depend on how the caller batches.
bool Compensator::feed(std::vector<Block>& blocks, std::vector<CompensatedBlock>& out) {
  for (Block& block : blocks)
    if (!take(block, out)) break;
  blocks.clear();
  return !passes_->diagnostics.stopped();
}

std::size_t Compensator::feed_until_report(std::span<Block> blocks,
                                           std::vector<CompensatedBlock>& out) {
  const std::vector<Diagnostic>& reports = passes_->diagnostics.pending();
  const std::size_t reports_before = reports.size();
  std::uint64_t line = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const bool in_next_line = index_of(blocks[i]) != std::exchange(line, index_of(blocks[i]));
    if (in_next_line && reports.size() > reports_before) return i;
    if (!take(blocks[i], out)) break;
  }
  return blocks.size();
}

bool Compensator::take(Block& block, std::vector<CompensatedBlock>& out) {
  ++passes_->reporting.summary().blocks_in;
  passes_->programmed = {&block, 1};
  const bool goes_on = passes_->step(Input::more, out);
  passes_->programmed = {};
  return goes_on;
}

bool Compensator::finish(const TrcMode& at_end, std::vector<CompensatedBlock>& out) {
  passes_->relevant_blocks.end_in(at_end);
  return passes_->step(Input::ended, out);
}

void Compensator::save(StateWriter& archive) const { archive(*passes_); }
void Compensator::load(StateReader& archive) { archive(*passes_); }

const Summary& Compensator::summary() const { return passes_->reporting.summary(); }

std::size_t Compensator::look_ahead() const {
  return passes_->relevant_blocks.look_ahead() + passes_->kerf_masking.look_ahead() +
         passes_->contour_masking.look_ahead() + passes_->transitions.look_ahead() +
         passes_->loop_removal.look_ahead() + passes_->clearance.look_ahead();
}

}  // namespace trc
