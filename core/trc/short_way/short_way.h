#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/tolerances.h"
#include "core/nc/state/block.h"
#include "core/trc/corner/corner.h"
#include "core/trc/loops/plain_entry.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/path_block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/setup.h"
#include "core/trc/short_way/at_corner.h"
#include "core/trc/short_way/into_loop_removal.h"
#include "core/trc/short_way/into_result.h"

namespace trc {

// The short way for what nearly all blocks of a program are: motion in the middle of a contour, of
// one mode and with nothing about it. Only Offset, Transitions and Reporting, or LoopRemoval, make
// anything of such blocks, so they go from the corner straight to the last two, without becoming
// path blocks.
//
// What comes out, and when, is bit for bit what the passes put out. It asks the same geometry
// the same questions; whatever is to be reported, but for the errors of LoopRemoval, or takes more
// than a rule for two blocks, it leaves to them: it stops before such a block, as if it had never
// been there.
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

  // Whether it ends in LoopRemoval now.
  [[nodiscard]] bool goes_into_loop_removal() const { return into_loop_removal_.is_open(); }
  // Whether a stretch of plain blocks may begin behind these two blocks: `open` has its start, but
  // not yet its end, `held` has neither. No pass behind Transitions holds or wants them, but
  // LoopRemoval where it holds the contour before them.
  [[nodiscard]] bool may_begin(const PathBlock& open, const PathBlock& held) const;
  // Takes blocks from the front of `blocks`, which then stand in `open` and `held`, and puts out
  // what lay before them. Returns how many; where any, last_out() is the one before `open`.
  std::size_t take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                   std::vector<CompensatedBlock>& out);

  [[nodiscard]] const Segment& last_out() const { return last_out_; }

 private:
  void begin(const PathBlock& held);
  // Whether the stretch goes as far as to this block.
  [[nodiscard]] bool takes(const MotionBlock& block) const;
  // Sets the equidistant of a block: behind the corner it begins at, before the one it ends at.
  void offset(MotionBlock& programmed, ShortStep& step, Corner& begin, Corner& end) const;

  // Puts out the block before the corner and what is inserted behind it. Returns false, and does
  // nothing, where the passes have to do it.
  bool join(const AtCorner& at, std::vector<CompensatedBlock>& out);
  bool join_inside(const AtCorner& at, std::vector<CompensatedBlock>& out);
  // Goes on once it is known what becomes of the corner, and whether what is inserted there can be
  // travelled.
  bool leave(const AtCorner& at, const Joint& joint, HeldPath::Reach inserted,
             std::vector<CompensatedBlock>& out);

  bool inverse_path_;
  Tolerances tolerances_;
  double input_resolution_;  // mm
  IntoLoopRemoval into_loop_removal_;
  IntoResult into_result_;
  // Of the stretch.
  const TrcMode* mode_ = nullptr;
  double shift_ = 0;  // as in Compensation
  Loops loops_ = Loops::kept;
  Tolerances exact_{};  // for the meetings of a contour whose loops are removed
  Segment last_out_{};
};

}  // namespace trc
