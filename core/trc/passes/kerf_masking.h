#pragma once

#include <optional>
#include <vector>

#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// KERF_MASKING: raises the bottom of a notch the tool cannot enter (rule 7.1, D-16).
//
//     --A     C--        B' lies on the bisector of the notch, as near to B as lets
//        \B' /           the tool in: of A–B' and B'–C the corners leave a length
//         \ /            that is not negative. Circles keep their sense, their
//          B             centre moves as little as it must.
//
// The programmed contour itself is changed, before the offset and also without one (SUPPRESS_TRC,
// D-17). P-CHAN-00284 = 0 is the older method (D-33): only between two lines, up to 90 degrees;
// ProgramState lets G141 and G140 switch it then.
//
// Holds two blocks of such a contour: a corner waits for the block after it, which shows what the
// next corner takes.
class KerfMasking {
 public:
  KerfMasking(bool circular, const Tolerances& tolerances)
      : circular_(circular), tolerances_(tolerances) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return held_.empty() && !wanted(block);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(before_, held_);
  }

 private:
  [[nodiscard]] bool wanted(const PathBlock& block) const {
    if (block.role == Role::passive || !block.at_end.active) return false;
    return block.mode().options.kerf_masking;
  }
  void release(PathBlocks& out);
  // Raises the corner of the two held blocks; `next` is the block after them, if any.
  void raise_notch(const PathBlock* next);

  bool circular_;
  Tolerances tolerances_;
  std::optional<PathBlock> before_;  // the first held block, as far as a corner needs it
  PathBlocks held_;
};

}  // namespace trc
