#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/tolerances.h"
#include "core/nc/state/block.h"
#include "core/trc/corner/corner.h"
#include "core/trc/loops/loop_removal.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/path_block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/setup.h"

namespace trc {

// The short way for what nearly all blocks of a program are: motion in the middle of a contour, of
// one mode and with nothing about it. Only Offset, Transitions and Reporting, or LoopRemoval, make
// anything of such blocks, so they go from the corner straight to the last two, without becoming
// path blocks.
//
// What comes out, and when, is bit for bit what the passes put out. It asks the same geometry
// the same questions; whatever is to be reported, or takes more than a rule for two blocks, it
// leaves to them: it stops before such a block, as if it had never been there.
class ShortWay {
 public:
  // The passes behind LoopRemoval: take all of `path`, and leave it empty. Returns false once the
  // stream must stop.
  using LeaveSelection = std::function<bool(PathBlocks& path, std::vector<CompensatedBlock>& out)>;

  ShortWay(const CompensatorSetup& setup, const Diagnostics& diagnostics, LoopRemoval& loop_removal,
           LeaveSelection leave_selection, Reporting& reporting)
      : inverse_path_(setup.inverse_path),
        tolerances_(setup.tolerances),
        input_resolution_(setup.leads.input_resolution),
        diagnostics_(diagnostics),
        loop_removal_(loop_removal),
        leave_selection_(std::move(leave_selection)),
        reporting_(reporting) {}

  // Whether a run may begin behind these two blocks: `open` has its start, but not yet its end,
  // `held` has neither. No pass behind Transitions holds or wants them, but LoopRemoval where it
  // holds the contour before them.
  [[nodiscard]] bool may_begin(const PathBlock& open, const PathBlock& held) const;
  // Takes blocks from the front of `blocks`, which then stand in `open` and `held`, and puts out
  // what lay before them. Returns how many; where any, last_out() is the one before `open`.
  std::size_t take(PathBlock& open, PathBlock& held, std::span<Block> blocks,
                   std::vector<CompensatedBlock>& out);

  [[nodiscard]] const Segment& last_out() const { return last_out_; }

 private:
  // A block between its two corners.
  struct Step {
    MotionBlock* programmed = nullptr;
    double length = 0;         // of the programmed path
    double extent = 0;         // of the programmed path, as extent_of()
    double radius = 1;         // of an arc: mm a unit of extent
    bool unreachable = false;  // as in PathBlock
    Vector tangent_at_start = Vector::UnitX();
    Point tool_start = Point::Zero();
    double cut_at_start = 0;  // as in PathBlock
  };

  void begin(const PathBlock& held);
  // Sets the equidistant of a block: behind the corner it begins at, before the one it ends at.
  void offset(MotionBlock& programmed, Step& step, Corner& begin, Corner& end) const;

  // Puts out the block before the corner and what is inserted behind it. Returns false, and does
  // nothing, where the passes have to do it.
  bool join(const Corner& corner, const Step& before, Step& after,
            std::vector<CompensatedBlock>& out);
  bool join_inside(const Corner& corner, const Step& before, Step& after,
                   std::vector<CompensatedBlock>& out);
  // Goes on once it is known what becomes of the corner. `gap` as in JoinedBlocks.
  bool leave(const Corner& corner, const Joint& joint, bool gap, const Step& before, Step& after,
             std::vector<CompensatedBlock>& out);
  bool put_out(const Corner& corner, const Joint& joint, const Step& before, const Step& after,
               std::vector<CompensatedBlock>& out);
  template <class Path>
  bool put_out(const Path& path, const Joint& joint, const Step& before, const Step& after,
               std::vector<CompensatedBlock>& out);
  void hold(const Corner& corner, const Joint& joint, bool gap, const Step& before,
            const Step& after);
  template <class Programmed, class Path>
  void hold(const Corner& corner, const Programmed& programmed, const Path& path,
            const HeldPath::Cuts& cuts, const Step& before);
  void hold_inserted(const Joint& joint, bool gap, const Step& before, const Step& after);
  // What a window of LoopRemoval has set free.
  void put_out_leaving(std::vector<CompensatedBlock>& out);
  bool inverse_path_;
  Tolerances tolerances_;
  double input_resolution_;  // mm
  const Diagnostics& diagnostics_;
  LoopRemoval& loop_removal_;
  LeaveSelection leave_selection_;
  Reporting& reporting_;
  // Of the run.
  const TrcMode* mode_ = nullptr;
  double shift_ = 0;  // as in Compensation
  bool removes_loops_ = false;
  Tolerances exact_{};  // for the meetings of a contour whose loops are removed
  bool going_ = true;
  Segment last_out_{};
  MotionBlock inserted_{};  // one after the other
  PathBlocks leaving_;      // between LoopRemoval and the passes behind it
};

}  // namespace trc
