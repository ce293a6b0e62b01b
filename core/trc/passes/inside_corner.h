#pragma once

#include <cstddef>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/path_block.h"
#include "core/trc/result/refused_way.h"

namespace trc {

// G238: a closed contour that begins and ends in its inside corner (rule 3.5).
//
//        last |   | first          X: where the offsets of the last and the first
//             |   |                   block meet; the tool comes from P1 to X, goes
//        -----+ X |                   round and leaves from X
//             P2--+-----
//                                  P1
//
// Holds a whole G238 selection: its last block is needed before the first can
// leave. Approach and retract block are given their point; other selections
// pass through at once.
class InsideCorner {
 public:
  InsideCorner(std::size_t selection_blocks, const Tolerances& tolerances, Diagnostics& diagnostics,
               Checkpoint& checkpoint, std::optional<RefusedWay>& refused_way)
      : selection_blocks_(selection_blocks),
        tolerances_(tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        refused_way_(refused_way) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return held_.empty() && !begins(block);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_);
  }

 private:
  [[nodiscard]] static bool begins(const PathBlock& block) {
    return block.role == Role::approach && block.mode().selection == Selection::inside_corner;
  }
  // Ends the held selection; `retract` is null at the end of the program.
  bool close(PathBlock* retract, PathBlocks& out);
  bool check_contour(const PathBlock& approach, const PathBlock& first, const PathBlock& last);
  bool check_start(const PathBlock& approach);
  // Keeps what is known where the approach is at fault.
  void keep_refused_way();
  bool give_points(PathBlock& approach, const PathBlock& first, PathBlock& last,
                   PathBlock* retract);
  [[nodiscard]] static std::vector<DiagnosticValue> named(const Source& selection_block);
  bool refuse(Code code, const PathBlock& block, std::vector<DiagnosticValue> values = {});

  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;
  std::optional<RefusedWay>& refused_way_;
  PathBlocks held_;  // the approach and the contour of one selection
};

}  // namespace trc
