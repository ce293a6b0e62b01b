#include "core/trc/compensator.h"

#include <optional>

#include "core/trc/entry_help.h"
#include "core/trc/loops/loop_removal.h"
#include "core/trc/pass.h"
#include "core/trc/passes/bottlenecks.h"
#include "core/trc/passes/contour_masking.h"
#include "core/trc/passes/contour_violations.h"
#include "core/trc/passes/convert_circles.h"
#include "core/trc/passes/kerf_masking.h"
#include "core/trc/passes/offset.h"
#include "core/trc/passes/relevant_blocks.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/passes/rounded_input.h"
#include "core/trc/passes/transitions.h"
#include "core/trc/selection/inside_corner.h"
#include "core/trc/selection/refused_way.h"
#include "core/trc/selection/split.h"
#include "core/trc/short_way/short_release.h"
#include "core/trc/short_way/short_way.h"
#include "core/trc/state_archive.h"

namespace trc {

namespace {

// What LoopRemoval refuses, which leads that the tool does not fit into may be the cause of.
bool may_be_of_leads(Code code) {
  return code == Code::line_reversed || code == Code::arc_wrapped || code == Code::most_left_out;
}

}  // namespace

// The passes and the blocks on their way between them.
struct Compensator::Passes {
  Passes(const CompensatorSetup& given, Diagnostics& log)
      : setup(given),
        diagnostics(log),
        checkpoint(setup.interrupt),
        engine(setup.engine),
        relevant_blocks(setup, log, refused_way),
        convert_circles(setup.tolerances),
        rounded_input(setup.leads.input_resolution),
        kerf_masking(setup.circular_kerf_masking, setup.tolerances),
        offset(setup.tolerances, log),
        inside_corner(setup.limits.selection_blocks, setup.tolerances, log, checkpoint,
                      refused_way),
        contour_masking(setup, log, checkpoint),
        transitions(setup.tolerances, log, refused_way),
        loop_removal(setup, log, checkpoint),
        contour_violations(setup.tolerances, log),
        bottlenecks(setup, log, checkpoint),
        reporting(setup, log),
        short_way(
            setup, log, loop_removal,
            [this](PathBlocks& free, std::vector<CompensatedBlock>& out) {
              path.blocks.swap(free);
              const bool goes_on = finish_path(Input::more, out);
              path.blocks.swap(free);
              return goes_on;
            },
            reporting),
        short_release(setup, loop_removal, reporting) {}

  // clang-format off
  bool step(Input input, std::vector<CompensatedBlock>& out) {
    if (diagnostics.stopped() || !find_path(input)) return false;
    unfinished = input;
    return go_on(out);
  }
  // Ends the step that was begun, or leaves more of it for the next call.
  bool go_on(std::vector<CompensatedBlock>& out) {
    while (loop_removal.is_leaving()) {
      if (!release(out)) return false;
      if (out.size() >= portion) return true;
    }
    const Input input = *unfinished;
    unfinished.reset();
    return finish_path(input, out);
  }
  // Blocks that leave a selection as they came go straight into the result; where one does not, a
  // few go through the passes.
  bool release(std::vector<CompensatedBlock>& out) {
    checkpoint.pass();
    const bool is_idle = path.blocks.empty() && bottlenecks.is_empty();
    if (is_idle && engine != Engine::passes && short_release.put_out(out, out.size() + some)) return true;
    return loop_removal.release_some(path.blocks) && finish_path(Input::more, out);
  }
  bool find_path(Input input) {
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
  bool finish_path(Input input, std::vector<CompensatedBlock>& out) {
    return apply  (contour_violations, path.blocks)
        && advance(bottlenecks,        path,        input, checkpoint)
        && advance(split,              path,        input, checkpoint)
        && advance(reporting,          path.blocks, out,   input, checkpoint);
  }
  // clang-format on

  // The passes that hold something. Nothing lies between them when a call has ended.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(relevant_blocks, rounded_input, kerf_masking, inside_corner, contour_masking,
            transitions, loop_removal, bottlenecks, reporting);
  }

  // Takes blocks from the front the short way, as far as that goes. Returns how many.
  std::size_t run(std::span<Block> blocks, std::vector<CompensatedBlock>& out) {
    if (engine == Engine::passes) return 0;
    const std::size_t worthwhile = engine == Engine::short_way ? 1 : 3;
    PathBlock* held = relevant_blocks.held();
    PathBlock* open = transitions.open_block();
    if (blocks.size() < worthwhile || held == nullptr || open == nullptr) return 0;
    if (diagnostics.stopped() || !short_way.may_begin(*open, *held) || !idle_for(*held)) return 0;
    const std::size_t count = short_way.take(*open, *held, blocks, out);
    if (count == 0) return 0;
    relevant_blocks.go_on_from_held();
    transitions.goes_on_behind(short_way.last_out());
    return count;
  }
  [[nodiscard]] bool idle_for(const PathBlock& block) const {
    return !relevant_blocks.counts_for_window(block) && rounded_input.ignores(block) &&
           kerf_masking.ignores(block) && inside_corner.ignores(block) &&
           contour_masking.ignores(block) &&
           (loop_removal.takes_contour() ||
            (loop_removal.ignores(block) && bottlenecks.ignores(block)));
  }

  // What would do in place of the block that was refused (D-122). Looks for it once.
  void help_with_entry() {
    if (!setup.helps_with_entries || diagnostics.pending().empty()) return;
    selection::RefusedWay refused = std::exchange(refused_way, {});
    if (may_be_of_leads(diagnostics.pending().back().code)) refused = loop_removal.refused_way();
    const bool left_out = diagnostics.pending().back().code == Code::most_left_out;
    if (refused.removes_loops && !refused.at_begin && !left_out) return;
    if (refused.blocks.empty()) return;
    const PathBlock* next = relevant_blocks.held();
    const bool goes_on = !refused.leaves && !refused.target && !refused.removes_loops &&
                         next != nullptr && next->role == Role::contour &&
                         start_of(next->programmed.path) == end_of(refused.blocks.back().path);
    if (goes_on) refused.blocks.push_back(next->programmed);
    diagnostics.help_with_entry(selection::help_with(refused, setup));
  }

  static constexpr std::size_t some = 32;  // of a portion

  CompensatorSetup setup;
  Diagnostics& diagnostics;
  Checkpoint checkpoint;
  Engine engine;
  selection::RefusedWay refused_way;  // by the pass that has stopped the stream
  RelevantBlocks relevant_blocks;
  ConvertCircles convert_circles;
  RoundedInput rounded_input;
  KerfMasking kerf_masking;
  Offset offset;
  selection::InsideCorner inside_corner;
  ContourMasking contour_masking;
  Transitions transitions;
  LoopRemoval loop_removal;
  ContourViolations contour_violations;
  Bottlenecks bottlenecks;
  selection::Split split;
  Reporting reporting;
  ShortWay short_way;
  ShortRelease short_release;

  std::span<Block> programmed;      // of the caller: one block
  std::optional<Input> unfinished;  // of a step: a selection is leaving
  OnTheWay<PathBlockPtr> path;
};

Compensator::Compensator(const CompensatorSetup& setup, Diagnostics& diagnostics)
    : passes_(std::make_unique<Passes>(setup, diagnostics)) {}

Compensator::~Compensator() = default;

// One block at a time through all passes: the order of diagnostics and what has
// come out before a stop must not depend on how the caller batches.
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

std::size_t Compensator::look_ahead() const {
  return passes_->relevant_blocks.look_ahead() + passes_->rounded_input.look_ahead() +
         passes_->kerf_masking.look_ahead() + passes_->contour_masking.look_ahead() +
         passes_->transitions.look_ahead() + passes_->loop_removal.look_ahead() +
         passes_->bottlenecks.look_ahead();
}

}  // namespace trc
