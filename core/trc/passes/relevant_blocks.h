#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/state/block.h"
#include "core/trc/path_block.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/setup.h"

namespace trc {

// Tells what each block is to TRC – approach, contour, retract, side change –
// and carries passive blocks (M words, dwell, motion across the plane) behind the
// motion block they were programmed after, so that the later passes see motion
// only. While TRC is off passive blocks go through at once.
//
// Holds one block while TRC is active: whether a selection has a contour at all
// shows with the block after its approach (D-28), and what would do in place of a circular approach
// with it too.
class RelevantBlocks {
 public:
  RelevantBlocks(const CompensatorSetup& setup, Diagnostics& diagnostics, RefusedWay& refused_way)
      : setup_(setup), diagnostics_(diagnostics), refused_way_(refused_way) {}

  bool feed(Block&& block, PathBlocks& out);
  bool drain(PathBlocks& out);

  // The block held back, if there is one. ShortWay puts a later one of the same mode in its
  // place.
  [[nodiscard]] PathBlock* held() { return held_.get(); }
  void go_on_from_held() { last_path_ = held_->programmed.path; }
  // Whether the selection of this block may yet turn out to be longer than its window.
  [[nodiscard]] bool counts_for_window(const PathBlock& block) const {
    const std::size_t window = setup_.limits.look_ahead_blocks;
    return window > 0 && contour_blocks_ <= window &&
           (block.mode().masking == Masking::on || setup_.implicit_contour_masking);
  }

  // The program ended in this mode: a G40 that nothing followed still ends the
  // contour. Called before drain.
  void end_in(const TrcMode& mode) { end_mode_ = mode; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, last_, last_mode_, last_path_, end_mode_, contour_blocks_);
  }

 private:
  bool attach_passive(PassiveBlock&& block, PathBlocks& out);
  bool follow(MotionBlock&& motion, PathBlocks& out);
  // Passes the held block on; `next` is the mode after it, if it is known.
  bool release(const TrcMode* next, PathBlocks& out);
  bool leave_selection(PathBlock& block, const TrcMode& next);

  bool classify(PathBlock& block);
  bool begin_selection(PathBlock& block);
  bool continue_selection(PathBlock& block);
  bool end_selection(PathBlock& block);
  [[nodiscard]] bool reverses(const PathBlock& block) const;
  bool warn_of_corner(const PathBlock& block);
  void count_for_window(const PathBlock& block);
  bool refuse(Code code, const PathBlock& block, std::string detail = {});
  // Of circles where only lines may be: what is known of the contour beside them.
  void keep_refused_approach(const MotionBlock& next);
  void keep_refused_retract(const PathBlock& retract);

  // Functions of the mode that exclude each other, or nothing.
  [[nodiscard]] static const char* excluded_pair(const TrcMode& mode);

  CompensatorSetup setup_;
  Diagnostics& diagnostics_;
  RefusedWay& refused_way_;
  PathBlockPtr held_;
  // What the motion block before left behind.
  Compensation last_{};
  std::shared_ptr<const TrcMode> last_mode_{};
  Segment last_path_{};
  // The mode the program ended in.
  std::optional<TrcMode> end_mode_;
  std::size_t contour_blocks_ = 0;  // of the selection, where a window counts them
};

}  // namespace trc
