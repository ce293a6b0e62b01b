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

// Decides the role of each block – approach, contour, retract, side change – and attaches passive
// blocks (M words, dwell, motion across the plane) to the motion block that they were programmed
// after, so that the later passes see motion only. While TRC is off passive blocks go through at
// once.
//
// Holds one block while TRC is active: only the block after an approach shows whether
// the selection has a contour at all (D-28), and what could replace a circular
// approach.
class RelevantBlocks {
 public:
  RelevantBlocks(const CompensatorSetup& setup, Diagnostics& diagnostics,
                 std::optional<RefusedWay>& refused_way)
      : setup_(setup), diagnostics_(diagnostics), refused_way_(refused_way) {}

  bool feed(Block&& block, PathBlocks& out);
  bool drain(PathBlocks& out);

  // The block held back, if there is one. ShortWay puts a later one of the same mode in its
  // place.
  [[nodiscard]] PathBlock* held() { return held_.get(); }
  void go_on_from_held() { last_path_ = held_->programmed.path; }
  // Whether the selection of this block may still become longer than its window.
  [[nodiscard]] bool counts_for_window(const PathBlock& block) const {
    const std::size_t window = setup_.limits.look_ahead_blocks;
    return window > 0 && contour_blocks_ <= window &&
           (block.mode().masking == Masking::on || setup_.implicit_contour_masking);
  }

  // The mode in which the program ended: a G40 as its last block still ends the contour. Called
  // before drain.
  void end_in(const TrcMode& mode) { end_mode_ = mode; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, last_, last_mode_, last_path_, end_mode_, contour_blocks_, without_length_);
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
  bool refuse_circle(const PathBlock& block);
  // For a circle where only a line is allowed: keeps what is known of the contour next to it.
  void keep_refused_approach(const MotionBlock& next);
  void keep_refused_retract(const PathBlock& retract);

  // Functions of the mode that exclude each other, or nothing.
  [[nodiscard]] static const char* excluded_pair(const TrcMode& mode);

  CompensatorSetup setup_;
  Diagnostics& diagnostics_;
  std::optional<RefusedWay>& refused_way_;
  PathBlockPtr held_;
  // The compensation after the motion block before.
  Compensation last_{};
  std::shared_ptr<const TrcMode> last_mode_{};
  Segment last_path_{};
  // The mode the program ended in.
  std::optional<TrcMode> end_mode_;
  std::size_t contour_blocks_ = 0;  // of the selection, where a window counts them
  Source without_length_{};         // a motion under TRC before its first block
};

}  // namespace trc
