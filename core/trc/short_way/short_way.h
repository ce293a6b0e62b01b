#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/tolerances.h"
#include "core/nc/state/block.h"
#include "core/trc/corner/corner.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/path_block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/setup.h"
#include "core/trc/short_way/at_corner.h"
#include "core/trc/short_way/into_loop_removal.h"
#include "core/trc/short_way/into_result.h"
#include "core/trc/short_way/plain_entry.h"

namespace trc {

// The short way for nearly all blocks of a program: motion within a contour, under one mode and
// with nothing special about it. Only Offset, Transitions and Reporting, or LoopRemoval, act on
// such blocks, so they go from the corner straight to one of the last two, without becoming path
// blocks.
//
// The output, and its timing, is bit for bit that of the passes, since the same geometry is called
// in the same way. Blocks with a diagnostic, except errors of LoopRemoval, or with a rule for more
// than two blocks are left to the passes: it stops before such a block, as if it had never been
// there.
class ShortWay {
 public:
  ShortWay(const CompensatorSetup& setup, const Diagnostics& diagnostics, LoopRemoval& loop_removal,
           IntoLoopRemoval::LeaveSelection leave_selection, Reporting& reporting)
      : inverse_path_(setup.inverse_path),
        tolerances_(setup.tolerances),
        input_resolution_(setup.leads.input_resolution),
        into_loop_removal_(setup.tolerances, diagnostics, LoopRemoval::PlainEntry(loop_removal),
                           std::move(leave_selection)),
        into_result_(setup.tolerances, reporting) {}

  // Whether it ends in LoopRemoval at present.
  [[nodiscard]] bool goes_into_loop_removal() const { return into_loop_removal_.is_open(); }
  // Whether a stretch of plain blocks may begin after these two blocks: `open` has its start, but
  // not yet its end, `held` has neither. No pass after Transitions holds or needs them, except
  // LoopRemoval where it holds the contour before them.
  [[nodiscard]] bool may_begin(const PathBlock& open, const PathBlock& held) const;
  // Takes blocks from the front of `blocks`; the last two end up in `open` and `held`, and the ones
  // before are put out. Returns how many; if any, last_out() is the one before `open`.
  std::size_t take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                   std::vector<CompensatedBlock>& out);

  [[nodiscard]] const Segment& last_out() const { return last_out_; }

 private:
  void begin(const PathBlock& held);
  // Whether the stretch includes this block.
  [[nodiscard]] bool takes(const MotionBlock& block) const;
  // Sets the equidistant of a block in both of its corners: after `begin`, before `end`.
  void offset(MotionBlock& programmed, ShortStep& step, Corner& begin, Corner& end) const;

  // Puts out the block before the corner and the blocks inserted after it. Returns false, without
  // doing anything, for blocks left to the passes.
  bool join(const AtCorner& at, std::vector<CompensatedBlock>& out);
  bool join_inside(const AtCorner& at, std::vector<CompensatedBlock>& out);
  // Goes on once the joint of the corner is known, and whether the blocks inserted there can be
  // travelled.
  bool leave(const AtCorner& at, const Joint& joint, HeldPath::Reach inserted,
             std::vector<CompensatedBlock>& out);

  bool inverse_path_;
  Tolerances tolerances_;
  double input_resolution_;  // mm
  IntoLoopRemoval into_loop_removal_;
  IntoResult into_result_;
  // Common to the stretch.
  const TrcMode* mode_ = nullptr;
  double shift_ = 0;  // as in Compensation
  Loops loops_ = Loops::kept;
  Tolerances exact_{};  // for the meetings of a contour whose loops are removed
  Segment last_out_{};
};

}  // namespace trc
