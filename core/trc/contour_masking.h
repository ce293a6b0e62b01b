#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/corner.h"
#include "core/trc/path_block.h"

namespace trc {

// G141: masks contour blocks that cannot be cut (spec 5.1).
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
// Holds a selection under G141 as a whole; all else passes through at once.
class ContourMasking {
 public:
  ContourMasking(std::size_t selection_blocks, const Tolerances& tolerances,
                 Diagnostics& diagnostics)
      : selection_blocks_(selection_blocks), tolerances_(tolerances), diagnostics_(diagnostics) {}

  bool feed(PathBlock block, std::vector<PathBlock>& out);
  bool drain(std::vector<PathBlock>& out) { return resolve(nullptr, out); }
  // Of the selections it holds as a whole; nothing else.
  [[nodiscard]] std::size_t look_ahead() const { return 0; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, kept_);
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

  // Decides over the held blocks; `after` follows them, if anything does.
  bool resolve(const PathBlock* after, std::vector<PathBlock>& out);
  bool keep(std::size_t index);
  bool close(const PathBlock* after);
  [[nodiscard]] std::optional<Meeting> meet(const PathBlock& before, PathBlock& after,
                                            bool adjacent) const;
  [[nodiscard]] std::optional<PathBlock::Rejoin> join_anew(const PathBlock& before,
                                                           const PathBlock& after) const;
  [[nodiscard]] bool survives(const Kept& kept, double cut_at_end) const;
  bool mask_last_kept();
  void report_masked();
  // The first or last block of the contour violates: 90017, 90019 or 90038.
  bool refuse_to_mask(const PathBlock& block);
  bool refuse(Code code, const PathBlock& block);

  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  std::vector<PathBlock> held_;
  std::vector<Kept> kept_;
};

}  // namespace trc
