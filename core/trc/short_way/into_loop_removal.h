#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/corner/corner.h"
#include "core/trc/path_block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/short_way/at_corner.h"
#include "core/trc/short_way/plain_entry.h"

namespace trc {

// The end of the short way in a contour whose loops are removed: the held path of LoopRemoval.
class IntoLoopRemoval {
 public:
  // The passes after LoopRemoval: take all of `path`, and leave it empty. Returns false once the
  // stream must stop.
  using LeaveSelection = std::function<bool(PathBlocks& path, std::vector<CompensatedBlock>& out)>;

  IntoLoopRemoval(const Tolerances& tolerances, const Diagnostics& diagnostics,
                  LoopRemoval::PlainEntry entry, LeaveSelection leave_selection)
      : tolerances_(tolerances),
        diagnostics_(diagnostics),
        entry_(entry),
        leave_selection_(std::move(leave_selection)) {}

  // Whether LoopRemoval holds the contour so far, so that the short way ends here.
  [[nodiscard]] bool is_open() const { return entry_.is_open(); }
  // Whether a stretch of plain blocks may begin after this block.
  [[nodiscard]] bool takes_more_like(const PathBlock& block) const {
    return entry_.takes_more_like(block);
  }
  void begin_run() {
    entry_.go_on_like_last();
    goes_on_ = true;
  }
  // Whether the stretch may go on after the last block that was taken.
  [[nodiscard]] bool goes_on() const { return goes_on_; }

  // Takes the block before the corner and the blocks inserted after it, reachable or not, and puts
  // out the blocks that a window releases then.
  void take(const AtCorner& at, const Joint& joint, HeldPath::Reach inserted,
            std::vector<CompensatedBlock>& out) {
    hold(at, joint, inserted);
    if (entry_.has_window()) put_out_leaving(out);
  }

 private:
  void hold(const AtCorner& at, const Joint& joint, HeldPath::Reach inserted);
  template <class Programmed, class Path>
  void hold(const Programmed& programmed, const Path& path, const HeldPath::Cuts& cuts,
            const AtCorner& at);
  void hold_inserted(const Joint& joint, HeldPath::Reach reach, const AtCorner& at);
  void put_out_leaving(std::vector<CompensatedBlock>& out);

  Tolerances tolerances_;
  const Diagnostics& diagnostics_;
  LoopRemoval::PlainEntry entry_;
  LeaveSelection leave_selection_;
  bool goes_on_ = true;
  MotionBlock inserted_{};  // one after the other
  PathBlocks leaving_;      // between LoopRemoval and the passes after it
};

}  // namespace trc
