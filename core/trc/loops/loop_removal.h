#pragma once

#include <cstddef>
#include <utility>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/loops/held_path_append.h"
#include "core/trc/loops/linear_transitions.h"
#include "core/trc/loops/loop_release.h"
#include "core/trc/loops/loop_walk.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"
#include "core/trc/path_block.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/setup.h"

namespace trc {

// G141 with REMOVE_MASKED_BLOCKS: takes every violating loop out of the path of a selection (rule
// 5.1), however many blocks it has. It holds the path, LoopWalk goes along it, LinearTransitions
// puts in what G25 asks for, and LoopRelease puts out what is left.
//
// Holds such a selection as a whole, or, with a window of N contour blocks (D-10), looks N blocks
// ahead and back: the path of a block leaves when the N-th block behind it has come. All else
// passes through at once.
class LoopRemoval {
 public:
  LoopRemoval(const CompensatorSetup& setup, Diagnostics& diagnostics, Checkpoint& checkpoint)
      : window_(setup.limits.look_ahead_blocks),
        selection_blocks_(setup.limits.selection_blocks),
        lead_settings_(setup.leads),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        obstacles_(path_, window_, tolerances_, checkpoint),
        walked_(path_, window_ > 0),
        walk_(setup, path_, obstacles_, walked_, diagnostics, checkpoint),
        linear_(path_, walked_, obstacles_, tolerances_, checkpoint),
        release_(setup, path_, walked_, obstacles_, diagnostics) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return !is_holding() && !leaving_ && !block.removes_loops();
  }
  // A selection that has ended leaves in portions, so that it does not lie in the vectors
  // between all passes at once. What is fed meanwhile waits behind it.
  [[nodiscard]] bool is_leaving() const { return leaving_; }
  bool release_some(PathBlocks& out);
  // Where what leaves next needs no block made for it: null otherwise, and while it still enters.
  [[nodiscard]] LoopRelease* releases_path() {
    return leaving_ && entering_.empty() ? &release_ : nullptr;
  }
  [[nodiscard]] const HeldPath& path() const { return path_; }
  // The selection it has stopped at, approach first and without the leads at the begin; no blocks
  // where not all of it is held any more.
  [[nodiscard]] RefusedWay refused_way() const;

  // The middle of a contour is being held: ShortWay may give it more of it.
  [[nodiscard]] bool takes_contour() const { return !leaving_ && end_of_contour() > 0; }
  // Whether what comes next may be given the short way if it is like this block.
  [[nodiscard]] bool takes_more_like(const PathBlock& block) const {
    return path_.follows_like(block);
  }
  // To be called before that.
  void go_on_like_last() { path_.go_on_like_last(); }
  // A contour block, as ShortWay has it behind blocks of the same mode and compensation.
  // `Programmed` and `Path` are Lines or Arcs.
  template <class Programmed, class Path>
  struct PlainBlock {
    const MotionBlock& block;
    const Programmed& programmed;  // its path
    const Path& path;              // of the tool
    HeldPath::Cuts cuts{};
    Certificate::Block course{};
    bool unreachable = false;  // as in PathBlock
  };
  // Returns false once the stream must stop.
  template <class Programmed, class Path>
  bool take(const PlainBlock<Programmed, Path>& plain, PathBlocks& out);
  // A transition between two of them, with what the one before has in common with the blocks before
  // it, or as `inserted`.
  template <class Path>
  bool take_transition(const Path& path, bool unreachable, const Source& source, PathBlocks& out);
  template <class Path>
  bool take_transition(const Path& path, bool unreachable, const MotionBlock& inserted,
                       PathBlocks& out);

  [[nodiscard]] std::size_t look_ahead() const { return window_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(entering_, path_, largest_radius_, farthest_reach_, gap_, has_linear_, has_short_,
            obstacles_, walked_, walk_, linear_, release_);
  }

 private:
  [[nodiscard]] bool is_holding() const { return !entering_.empty() || !path_.empty(); }
  void begin_selection();
  bool end_selection();
  bool hold(PathBlock& block);
  [[nodiscard]] bool has_room_for(const Source& source) {
    const bool is_countable = path_.end() < HeldPath::most_blocks / 4;
    return (is_countable && path_.size() < selection_blocks_) || has_no_room_for(source);
  }
  // Returns false.
  bool has_no_room_for(const Source& source);
  void note_contour_block(const Box& programmed, const Certificate::Block& course);
  // Once the contour has ended, if its begin is still known: what of it is a wall (D-38).
  void find_walls();
  [[nodiscard]] bool note_transition(bool unreachable, PathBlocks& out);
  bool proceed(PathBlocks& out);
  // Up to which piece the path may leave whose window has come: what stands in place of an arc
  // takes part of the block before it.
  [[nodiscard]] std::size_t settle(std::size_t due);
  void forget();
  void release_entry(PathBlocks& out);

  [[nodiscard]] HeldPath::ContourBlock contour(std::size_t number) const {
    return path_.contour_block(number);
  }
  [[nodiscard]] std::size_t end_of_path() const { return path_.end(); }
  [[nodiscard]] std::size_t end_of_contour() const { return path_.end_of_contour(); }

  std::size_t window_;
  std::size_t selection_blocks_;
  LeadSettings lead_settings_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;

  PathBlocks entering_;  // the approach, which leaves with the first block of the path
  HeldPath path_;
  double largest_radius_ = 0;
  double farthest_reach_ = 0;  // how far from a block its path may lie, mm
  bool gap_ = false;           // the next contour block does not meet the last one
  bool has_linear_ = false;    // the selection asks for linear transitions
  bool has_short_ = false;     // a contour block may be one of a bow tie
  Obstacles obstacles_;
  WalkedPath walked_;
  LoopWalk walk_;
  LinearTransitions linear_;
  LoopRelease release_;

  bool leaving_ = false;
  PathBlocks behind_;
  PathBlocks were_behind_;  // while they are fed again; holds nothing else
  bool ended_ = false;      // nothing comes behind that
};

template <class Programmed, class Path>
[[gnu::always_inline]] inline bool LoopRemoval::take(const PlainBlock<Programmed, Path>& plain,
                                                     PathBlocks& out) {
  if (!has_room_for(plain.block.source)) return false;
  path_.append_contour(plain.block, plain.programmed, plain.path, plain.cuts, plain.unreachable);
  note_contour_block(bounding_box(plain.programmed), plain.course);
  return window_ == 0 || proceed(out);
}

template <class Path>
[[gnu::always_inline]] inline bool LoopRemoval::take_transition(const Path& path, bool unreachable,
                                                                const Source& source,
                                                                PathBlocks& out) {
  if (!has_room_for(source)) return false;
  path_.append_transition(path, unreachable);
  return note_transition(unreachable, out);
}

template <class Path>
[[gnu::always_inline]] inline bool LoopRemoval::take_transition(const Path& path, bool unreachable,
                                                                const MotionBlock& inserted,
                                                                PathBlocks& out) {
  if (!has_room_for(inserted.source)) return false;
  path_.append_transition(inserted, path, unreachable);
  return note_transition(unreachable, out);
}

inline bool LoopRemoval::note_transition(bool unreachable, PathBlocks& out) {
  gap_ = gap_ || unreachable;
  return window_ == 0 || proceed(out);
}

}  // namespace trc
