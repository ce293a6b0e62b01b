#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/trc/compensator.h"
#include "core/trc/pass.h"
#include "core/trc/passes/bottlenecks.h"
#include "core/trc/passes/contour_masking.h"
#include "core/trc/passes/contour_violations.h"
#include "core/trc/passes/convert_circles.h"
#include "core/trc/passes/inside_corner.h"
#include "core/trc/passes/kerf_masking.h"
#include "core/trc/passes/loop_removal.h"
#include "core/trc/passes/offset.h"
#include "core/trc/passes/relevant_blocks.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/passes/rounded_input.h"
#include "core/trc/passes/split.h"
#include "core/trc/passes/transitions.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/short_way/short_release.h"
#include "core/trc/short_way/short_way.h"
#include "core/trc/state_archive.h"
#include "core/trc/walls/state_archive.h"

namespace trc {

// The ways through the core that an engine allows.
struct Ways {
  // Blocks that must come at once for the short way in.
  std::size_t least_in = std::numeric_limits<std::size_t>::max();
  bool short_out = false;  // for selections whose loops are removed
};
[[nodiscard]] inline Ways ways_of(Engine engine) {
  switch (engine) {
    case Engine::automatic:
      return {.least_in = 3, .short_out = true};
    case Engine::passes:
      return {};
    case Engine::short_way:
      return {.least_in = 1, .short_out = true};
  }
  return {};
}

// The passes and the blocks on their way between them.
struct Compensator::Passes {
  Passes(const CompensatorSetup& given, Diagnostics& log)
      : setup(given),
        diagnostics(log),
        checkpoint(setup.interrupt),
        ways(ways_of(setup.engine)),
        relevant_blocks(setup, log, refused_way),
        convert_circles(setup.tolerances),
        rounded_input(setup.leads.input_resolution, setup.tolerances),
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

  // One block through all passes, or the end of the stream.
  bool step(Input input, std::vector<CompensatedBlock>& out);
  // Finishes the step that was begun, or leaves the rest of it for the next call.
  bool go_on(std::vector<CompensatedBlock>& out);
  // A few blocks of a selection that is leaving.
  bool release(std::vector<CompensatedBlock>& out);
  // The order of the passes: find_path, then finish_path.
  bool find_path(Input input);
  bool finish_path(Input input, std::vector<CompensatedBlock>& out);

  // Takes blocks from the front along the short way, as far as possible. Returns how many.
  std::size_t run(std::span<Block> blocks, std::vector<CompensatedBlock>& out);
  // Whether the passes that the short way skips have nothing to do with the block.
  [[nodiscard]] bool are_idle_for(const PathBlock& block) const;

  // Adds proposals in place of the refused block (D-122). Looks for them once.
  void help_with_entry();

  // Saves the passes that hold blocks. Nothing lies between passes after a call.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(relevant_blocks, rounded_input, kerf_masking, inside_corner, contour_masking,
            transitions, loop_removal, bottlenecks, reporting);
  }

  static constexpr std::size_t blocks_per_step = 32;  // of a portion

  CompensatorSetup setup;
  Diagnostics& diagnostics;
  Checkpoint checkpoint;
  Ways ways;
  std::optional<RefusedWay> refused_way;  // by the pass that has stopped the stream
  RelevantBlocks relevant_blocks;
  ConvertCircles convert_circles;
  RoundedInput rounded_input;
  KerfMasking kerf_masking;
  Offset offset;
  InsideCorner inside_corner;
  ContourMasking contour_masking;
  Transitions transitions;
  LoopRemoval loop_removal;
  ContourViolations contour_violations;
  Bottlenecks bottlenecks;
  Split split{setup.tolerances};
  Reporting reporting;
  ShortWay short_way;
  ShortRelease short_release;

  std::span<Block> programmed;      // of the caller: one block
  std::optional<Input> unfinished;  // of a step: a selection is leaving
  OnTheWay<PathBlockPtr> path;
};

}  // namespace trc
