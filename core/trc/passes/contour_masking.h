#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/corner/corner.h"
#include "core/trc/path_block.h"
#include "core/trc/setup.h"
#include "core/trc/walls/left_out.h"
#include "core/trc/walls/walls.h"

namespace trc {

// G141: masks contour blocks that cannot be cut (rule 5.1).
//
//     A =====+            A' ----X          B lies between its neighbours so that
//             \ B                |          they leave nothing of it: it is masked,
//              + C               | C'       and A and C are joined anew in X.
//              |
//
// A block is masked when its own violation criterion holds (90017, 90019, 90038),
// which may leave its neighbours to the same fate, until none is left (D-09). The first
// and the last contour block of a selection stay: where they violate, the contour
// cannot be machined with this radius and the stream stops.
//
// Holds a selection under G141 as a whole or, with a window (D-10), that many of its
// blocks: a block that has left can no longer be masked. All else passes through at
// once.
class ContourMasking {
 public:
  ContourMasking(const CompensatorSetup& setup, Diagnostics& diagnostics, Checkpoint& checkpoint)
      : window_(setup.limits.look_ahead_blocks),
        selection_blocks_(setup.limits.selection_blocks),
        lead_settings_(setup.leads),
        largest_masked_share_(setup.largest_masked_share),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out) { return resolve(nullptr, out); }
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return held_.empty() && !(block.at_end.active && masks(block));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, base_, kept_, longest_left_out_, contour_length_);
  }

 private:
  // A block that is not masked so far, and the cut of its start corner.
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
  // Joins two blocks given by index; all blocks between them are masked.
  [[nodiscard]] std::optional<Meeting> meet(std::size_t before, std::size_t after) const;
  [[nodiscard]] std::optional<PathBlock::Rejoin> join_anew(std::size_t before,
                                                           std::size_t after) const;
  // Whether the masked blocks between the two stay out of the way where the path goes on in line.
  [[nodiscard]] bool are_passed(std::size_t before, std::size_t after,
                                const PathBlock::Rejoin& in_line) const;
  [[nodiscard]] bool survives(const Kept& kept, double cut_at_end) const;
  // `joining`: the block that could not be joined to it.
  bool mask_last_kept(std::size_t joining);
  // Releases the first kept block and the masked ones after it.
  bool release(PathBlocks& out);
  void report_masked(std::size_t first, std::size_t end);
  // The masked blocks from `first` on and before `end`, which moves to the first block after.
  [[nodiscard]] LeftOut left_out(std::size_t first, std::size_t& end) const;
  // Whether masked blocks begin with this one, after a kept one.
  [[nodiscard]] bool begins_masked(std::size_t index) const {
    return held(index).masked && !(index > base_ && held(index - 1).masked);
  }
  [[nodiscard]] double cut_off_beside(std::size_t first, std::size_t end) const;
  // Finds the walls of the held contour (D-38), as far as its start is known.
  void find_walls();
  [[nodiscard]] double wall_length(std::size_t index) const;
  // The number of a held block among those of the contour.
  [[nodiscard]] std::size_t number_of(std::size_t index) const {
    return index - (base_ == 0 && held_.front()->role != Role::contour ? 1 : 0);
  }
  // Whether a stretch of masked blocks may not be left out whatever its share (D-39).
  [[nodiscard]] bool holds_a_whole(std::size_t first, std::size_t end,
                                   const LeftOut& stretch) const;
  // Refuses a contour too much of which is masked: one stretch, or all long ones (D-39).
  bool check_left_out();
  // These blocks, the first or last one of the contour among them, cannot be passed: 90017, 90019
  // or 90038 for the block that the tool cannot reach, with the largest tool that could.
  bool refuse_to_mask(std::size_t first, std::size_t last);
  bool refuse(Code code, const PathBlock& block, std::optional<double> largest_radius);

  [[nodiscard]] PathBlock& held(std::size_t index) { return *held_[index - base_]; }
  [[nodiscard]] const PathBlock& held(std::size_t index) const { return *held_[index - base_]; }

  std::size_t window_;
  std::size_t selection_blocks_;
  LeadSettings lead_settings_;
  double largest_masked_share_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;
  PathBlocks held_;
  std::size_t base_ = 0;  // blocks of the selection that have left
  std::vector<Kept> kept_;
  Walls walls_{};  // of a contour that has ended, until it has left
  // For a window only: lengths of the path that has left, and of all contour blocks, mm.
  LeftOut longest_left_out_{};
  double contour_length_ = 0;
};

}  // namespace trc
