#pragma once

#include <cstddef>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/geometry/box_tree.h"
#include "core/trc/path_block.h"

namespace trc {

// Looks for bottlenecks: path blocks that come closer to any programmed block of
// their selection than the tool radius, however far apart on the contour. Under
// G141 each is a warning (rule 5.1: loops that still violate stay); with
// P-CHAN-00219 the first one stops, also under G140 (D-34).
//
// Holds such a selection as a whole, or looks a window of contour blocks ahead and
// back (D-10); all else passes through at once.
class Clearance {
 public:
  // `window` in contour blocks; 0: the whole selection.
  Clearance(bool implicit_contour_masking, std::size_t window, std::size_t selection_blocks,
            const Tolerances& tolerances, Diagnostics& diagnostics, Checkpoint& checkpoint)
      : implicit_(implicit_contour_masking),
        window_(window),
        selection_blocks_(selection_blocks),
        tolerances_(tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out) { return end_selection(out); }
  [[nodiscard]] bool is_empty() const { return held_.empty() && contour_.empty(); }
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return is_empty() &&
           (block.removes_loops() || (!implicit_ && block.mode().masking == Masking::off));
  }
  [[nodiscard]] std::size_t look_ahead() const { return window_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, numbers_, contour_, contour_base_, violating_);
    boxes_ = BoxTree(contour_base_);
    for (const MotionBlock& block : contour_) boxes_.append(bounding_box(block.path));
  }

 private:
  // A warning may come later than the block: it need not wait for its window.
  [[nodiscard]] bool passes_at_once() const { return window_ > 0 && !implicit_; }
  void hold(PathBlockPtr block);
  bool end_selection(PathBlocks& out);
  // Lets go all blocks around which the contour is known.
  bool examine(bool ended, PathBlocks& out);
  bool check(const PathBlock& block, std::size_t number);
  void forget();
  bool report(const PathBlock& path, const MotionBlock& contour, double distance,
              const Point& place);

  bool implicit_;
  std::size_t window_;
  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;
  PathBlocks held_;
  std::vector<std::size_t> numbers_;  // of the contour block, or of the one before it

  // The contour, counted from the begin of the selection, as far as a window reaches.
  std::vector<MotionBlock> contour_;
  std::size_t contour_base_ = 0;
  BoxTree boxes_;
  bool violating_ = false;  // so was the block before: one report for a stretch
};

}  // namespace trc
