#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/corner/corner.h"
#include "core/trc/path_block.h"

namespace trc {

// G141: masks contour blocks that cannot be cut (rule 5.1).
//
//     A =====+            A' ----X          B lies between its neighbours so that
//             \ B                |          they leave nothing of it: it is masked,
//              + C               | C'       and A and C are joined anew in X.
//              |
//
// A block is masked when its own violation criterion holds (90017, 90019, 90038),
// which may leave its neighbours to the same fate, until none is left. The first
// and the last contour block of a selection stay: where they violate, the contour
// cannot be machined with this radius and the stream stops.
//
// Holds a selection under G141 as a whole, or, with a window (D-10), so many of its
// blocks: of those that have left none can be masked any more. All else passes
// through at once.
class ContourMasking {
 public:
  // `window` in contour blocks; 0: the whole selection.
  ContourMasking(std::size_t window, std::size_t selection_blocks, const Tolerances& tolerances,
                 Diagnostics& diagnostics, Checkpoint& checkpoint)
      : window_(window),
        selection_blocks_(selection_blocks),
        tolerances_(tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out) { return resolve(nullptr, out); }
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return held_.empty() && !(block.at_end.active && masks(block));
  }
  [[nodiscard]] std::size_t look_ahead() const { return window_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, base_, kept_);
  }

 private:
  // A block that is not masked so far, and what its start corner takes off it.
  struct Kept {
    std::size_t index = 0;
    double cut_at_start = 0;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(index, cut_at_start);
    }
  };
  // The joint of two kept blocks: of the corner, or anew over masked blocks.
  struct Meeting {
    double cut_before = 0;
    double cut_after = 0;
    std::optional<PathBlock::Rejoin> rejoin{};
  };

  [[nodiscard]] static bool masks(const PathBlock& block) {
    return block.role != Role::passive && block.mode().masking == Masking::on &&
           !block.removes_loops();
  }
  // Decides over the held blocks; `after` follows them, if anything does.
  bool resolve(const PathBlock* after, PathBlocks& out);
  bool keep(std::size_t index);
  bool close(const PathBlock* after);
  // The two by their index; all between them are masked.
  [[nodiscard]] std::optional<Meeting> meet(std::size_t before, std::size_t after) const;
  [[nodiscard]] std::optional<PathBlock::Rejoin> join_anew(std::size_t before,
                                                           std::size_t after) const;
  // Whether the masked blocks between the two stay out of the way where the path goes on in line.
  [[nodiscard]] bool are_passed(std::size_t before, std::size_t after,
                                const PathBlock::Rejoin& in_line) const;
  [[nodiscard]] bool survives(const Kept& kept, double cut_at_end) const;
  bool mask_last_kept();
  // The first kept block, and the masked ones behind it.
  bool let_go(PathBlocks& out);
  void report_masked(std::size_t first, std::size_t end);
  // The first or last block of the contour violates: 90017, 90019 or 90038.
  bool refuse_to_mask(const PathBlock& block);
  bool refuse(Code code, const PathBlock& block);

  [[nodiscard]] PathBlock& held(std::size_t index) { return *held_[index - base_]; }
  [[nodiscard]] const PathBlock& held(std::size_t index) const { return *held_[index - base_]; }

  std::size_t window_;
  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;
  PathBlocks held_;
  std::size_t base_ = 0;  // blocks of the selection that have left
  std::vector<Kept> kept_;
};

}  // namespace trc
