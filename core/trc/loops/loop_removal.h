#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/geometry/box_tree.h"
#include "core/trc/compensator.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/linear_transitions.h"
#include "core/trc/loops/loop_exit.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"
#include "core/trc/path_block.h"
#include "core/trc/selection/refused_way.h"
#include "core/trc/walls/left_out.h"

namespace trc {

// G141 with REMOVE_MASKED_BLOCKS: takes every violating loop out of the path of a
// selection (rule 5.1), however many blocks it has.
//
//        raw            result       The path is walked from its first point. Where it
//      |  _           |              comes nearer than the tool radius to any contour
//    --x-' )        --x              block, it goes on along the part of the path that
//      '--'                          crosses it there, x, and drops what lies between.
//
// A dropped contour block is masked: its technology words, and what it moves across
// the plane and in tracking axes, come out at the crossing. A loop that stays clear
// of the contour stays. Where there is no crossing to go on from, the contour cannot
// be machined with this radius, and the stream stops (90019, 90038).
//
// Holds such a selection as a whole, or, with a window of N contour blocks (D-10),
// looks N blocks ahead and back: the path of a block leaves when the N-th block behind
// it has come. All else passes through at once.
class LoopRemoval {
 public:
  LoopRemoval(const CompensatorSetup& setup, Diagnostics& diagnostics, Checkpoint& checkpoint)
      : window_(setup.limits.look_ahead_blocks),
        selection_blocks_(setup.limits.selection_blocks),
        lead_settings_(setup.leads),
        largest_masked_share_(setup.largest_masked_share),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        obstacles_(path_, window_, tolerances_, checkpoint),
        walked_(path_, window_ > 0),
        exits_(path_, walked_, obstacles_, tolerances_, checkpoint),
        linear_(path_, walked_, obstacles_, tolerances_, checkpoint) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return !is_holding() && !leaving_ && !block.removes_loops();
  }
  // A selection that has ended leaves in portions, so that it does not lie in the vectors
  // between all passes at once. What is fed meanwhile waits behind it.
  [[nodiscard]] bool is_leaving() const { return leaving_; }
  bool let_go_some(PathBlocks& out);
  // The next blocks of path() that leave as they came: with nothing before them, no riders, and up
  // to `most`. None where `count` is 0.
  struct Row {
    std::size_t first = 0;
    std::size_t count = 0;
  };
  [[nodiscard]] Row next_as_they_came(std::size_t most) const;
  void have_left(std::size_t count);
  // What is travelled of the next block of path(), where that is not all of it, and nothing comes
  // out before it and rides on it; else null.
  [[nodiscard]] const PathPiece* next_part() const;
  void part_has_left();
  // Passes by a loop that is left out next, if nothing comes out in its place.
  void pass_by_without_trace();
  [[nodiscard]] const HeldPath& path() const { return path_; }
  // The selection it has stopped at, approach first and without the leads at the begin; no blocks
  // where not all of it is held any more.
  [[nodiscard]] selection::RefusedWay refused_way() const;

  // The middle of a contour is being held: ContourRun may give it more of it.
  [[nodiscard]] bool takes_contour() const { return !leaving_ && end_of_contour() > 0; }
  // Whether what comes next may be given the short way if it is like this block.
  [[nodiscard]] bool takes_more_like(const PathBlock& block) const {
    return path_.follows_like(block);
  }
  // To be called before that.
  void go_on_like_last() { path_.go_on_like_last(); }
  // A contour block, as ContourRun has it behind blocks of the same mode and compensation.
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
    archive(entering_, path_, largest_radius_, apart_, obstacles_, walking_, walked_, at_,
            tolerated_.from, tolerated_.until, tolerated_.nearness, passes_, next_, has_linear_,
            linear_, left_to_, longest_left_out_, contour_length_);
    if constexpr (Archive::is_loading::value) exact_from_ = walked_.end();
  }

 private:
  // Blocks of the path are counted from the begin of the selection, contour blocks too.
  using Onset = Obstacles::Onset;
  using Nearness = Obstacles::Nearness;
  enum class Step { done, wait, stop };
  // Up to where the path may come how near. What lies before `from` has been looked at.
  struct Tolerated {
    double from = 0;  // mm along the block of `until`
    PathPlace until{};
    Nearness nearness = Nearness::passable;
  };
  // Where the walk might have left the path for its continuation, and has not.
  struct Pass {
    std::size_t block = 0;
    LoopExit exit{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, exit.piece, exit.leaves, exit.continues, exit.point);
    }
  };

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
  void reconsider(std::size_t number, const Box& area);
  void walk_again_from(std::size_t piece, const Onset& onset);
  // The last contour block is new: whether the path runs into it before the onset waited with.
  void keep_waiting();
  // Whether the walk cannot go on yet: the last contour block that is known is what it ran into.
  [[nodiscard]] bool is_waiting() const;
  void drop_pieces(std::size_t kept);
  bool proceed(PathBlocks& out);
  // Up to which piece the path may leave whose window has come: what stands in place of an arc
  // takes part of the block before it.
  [[nodiscard]] std::size_t settle(std::size_t due);
  void forget();

  // As far as the contour is known well enough; all the way when it has ended.
  bool walk(bool ended);
  bool begin_walk(bool ended);
  // What to do about an onset in the block being walked.
  Step leave(const Onset& onset, bool ended);
  Step leave_at_once(const Onset& onset, bool ended);
  // The path has come into the tool's reach, but not so far that it violates yet.
  void pass(const Onset& onset, const std::optional<LoopExit>& exit);
  // For as long as the path stays within reach of the obstacle.
  void tolerate(const Onset& onset, Nearness nearness);
  // The block being walked is travelled backwards. Returns whether there is a way to leave it out.
  bool leave_backwards();
  // Where nothing leads on from a violation: the last pass whose loop holds it is none.
  bool leave_for_last_pass();
  // Whether it is so little that it counts as none.
  [[nodiscard]] bool counts_as_none(const Onset& violation);
  // Whether what leads from here to there is all of a closed contour: no loop.
  [[nodiscard]] bool is_seam(const LoopExit& exit) const;
  // Whether these contour blocks, and some more of one by that, mm, can have the tool between them:
  // a room whose neck is at the seam.
  [[nodiscard]] bool encloses_room(std::size_t first, std::size_t end, double rest) const;
  [[nodiscard]] bool is_closed() const;
  // How far from the first and the last point of the path that may be, mm and blocks.
  [[nodiscard]] double near_seam() const { return 0.01 * std::max(path_.radius_of_tool(0), 0.1); }
  static constexpr std::size_t most_blocks_of_seam = 64;
  // Whether the place of the onset is as good as the first point of the path, or as the last one.
  [[nodiscard]] bool is_at_begin(const Onset& onset) const;
  [[nodiscard]] bool is_at_end(const Onset& onset) const;
  void jump(const LoopExit& exit);
  void advance();
  // The same for all blocks before this one.
  void advance_to(std::size_t block);
  // Walked: a piece of the block that has been walked so far.
  void keep_cut();
  // Whether some of the block being walked may come nearer than `Nearness::exact` allows.
  [[nodiscard]] bool is_tolerated() const { return tolerated_.until.block >= at_.block; }

  [[nodiscard, gnu::always_inline]] HeldPath::Block path(std::size_t block) const {
    return path_.block(block);
  }
  [[nodiscard, gnu::always_inline]] HeldPath::ContourBlock contour(std::size_t number) const {
    return path_.contour_block(number);
  }
  [[nodiscard]] std::size_t end_of_path() const { return path_.end(); }
  [[nodiscard]] std::size_t end_of_contour() const { return path_.end_of_contour(); }
  [[nodiscard]] std::size_t number_of(std::size_t block) const { return path_.number_of(block); }
  // Whether the contour is known `lead` blocks beyond the path block.
  [[nodiscard]] bool is_known(std::size_t block, std::size_t lead, bool ended) const;

  // The onset that counts, with the loops that do not violate let pass.
  [[nodiscard]] std::optional<Onset> next_onset() const;
  // Nothing is left between the corners of the block: it is travelled backwards.
  [[nodiscard]] bool runs_backwards(std::size_t block) const;
  // Whether the loop between two places soon does; it begins where the path enters the obstacle.
  [[nodiscard]] bool violates_soon(const PathPlace& from, const PathPlace& to,
                                   std::size_t obstacle) const;

  [[nodiscard]] bool next_stands_for_itself() const;
  [[nodiscard]] std::size_t end_of_portion() const;
  void let_go_to(std::size_t end, PathBlocks& out);
  void let_go(std::size_t number, PathBlocks& out);
  void let_go_linear(std::size_t transition, PathBlocks& out);
  // The blocks before `next` that are not travelled: a loop, left out at `place`.
  void pass_by(const PathPlace& next, const Point& place, PathBlocks& out);
  // The last contour block of those, or else the first of them; there is at least one.
  [[nodiscard]] std::size_t last_dropped_before(std::size_t end) const;
  // Whether nothing comes out in their place.
  [[nodiscard]] bool leave_no_trace(std::size_t end) const;
  // What is left out before the next place, at the point.
  void report_masked(const PathPlace& next, const Point& place);
  // From one place of the path to another one, which are next to a loop (D-39).
  [[nodiscard]] LeftOut left_out(const PathPlace& from, const PathPlace& to) const;
  // Refuses a contour most of which goes in one loop.
  bool check_left_out();
  bool refuse(const Onset& onset);

  std::size_t window_;
  std::size_t selection_blocks_;
  LeadSettings lead_settings_;
  double largest_masked_share_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;

  PathBlocks entering_;  // the approach, which leaves with the first block of the path
  HeldPath path_;
  double largest_radius_ = 0;
  bool apart_ = false;  // the next contour block does not meet the last one
  Obstacles obstacles_;

  WalkedPath walked_;
  LoopExits exits_;
  LinearTransitions linear_;
  bool has_linear_ = false;    // the selection asks for some
  double farthest_reach_ = 0;  // how far from a block its path may lie, mm
  // For a window only: the first piece of, or behind, the chain that ends with the last contour
  // block.
  std::size_t first_of_chain_ = 0;
  // Likewise: the pieces from this one on come no nearer than `Nearness::exact` allows.
  std::size_t exact_from_ = 0;
  // Likewise: where the block being walked runs into the last contour block, and into no other one
  // before that. Nothing can be done about it before there are more.
  std::optional<Onset> waiting_with_;
  bool walking_ = false;
  PathPiece at_{};  // the piece being walked
  Tolerated tolerated_{};
  std::vector<Pass> passes_;  // the last ones, whose loops the walk may still be in
  std::size_t next_ = 0;      // the first block that has neither left nor been dropped
  static constexpr PathPlace none_left{HeldPath::most_blocks, 0};
  PathPlace left_to_ = none_left;  // up to here a part of a block has left
  // For a window only: of what has left, and of all contour blocks, mm.
  LeftOut longest_left_out_{};
  double contour_length_ = 0;

  bool leaving_ = false;
  PathBlocks behind_;
  bool ended_ = false;  // nothing comes behind that
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
  apart_ = apart_ || unreachable;
  return window_ == 0 || proceed(out);
}

}  // namespace trc
