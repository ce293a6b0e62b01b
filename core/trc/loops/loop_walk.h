#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/geometry/box_tree.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/loop_exit.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/seam.h"
#include "core/trc/loops/walked_path.h"
#include "core/trc/setup.h"
#include "core/trc/walls/closing_watch.h"

namespace trc {

// Goes along the path of a selection from its first point and notes the parts that are travelled
// (rule 5.1). Where the path comes nearer than the tool radius to any contour block, the walk goes
// on along the part of the path that crosses it there, x, and leaves out what lies between. A loop
// that stays clear of the contour stays. Where there is no crossing to go on from, the contour
// cannot be machined with this radius (90019, 90038).
//
//        raw            result
//      |  _           |
//    --x-' )        --x
//      '--'
//
// With a window of N contour blocks, each new block may be in the way of the path already walked:
// from there the path is walked again.
class LoopWalk {
 public:
  // The path, the obstacles in its way, the pieces walked, and where the contour may close.
  struct Rooms {
    const HeldPath& path;
    Obstacles& obstacles;
    WalkedPath& walked;
    const ClosingWatch& closing;
  };

  LoopWalk(const CompensatorSetup& setup, const Rooms& rooms, Diagnostics& diagnostics,
           Checkpoint& checkpoint)
      : path_(rooms.path),
        obstacles_(rooms.obstacles),
        walked_(rooms.walked),
        closing_(rooms.closing),
        window_(setup.limits.look_ahead_blocks),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        seam_(path_, tolerances_),
        exits_(path_, walked_, obstacles_, tolerances_, checkpoint) {}

  // A new selection begins.
  void begin();
  // For a window only: a contour block has come, in that box. A block of the path is at most
  // `farthest_reach`, mm, away from its contour block.
  void note_contour_block(const Box& area, double farthest_reach);
  // The contour has come to its end.
  void end_contour() { ended_ = true; }
  // The walls have changed: the path that has not left is walked again.
  void start_over();

  // Once the contour has ended: walks the whole path if it is short and nothing of it is in the way
  // of the contour, whichever blocks are walls. Returns false where it has not.
  bool go_undisturbed();
  // Walks as far as the contour is known well enough; all the way when it has ended. Returns false
  // once the stream must stop.
  bool go_on();
  // Whether it cannot go on yet, because it ran into the last contour block known.
  [[nodiscard]] bool is_waiting() const;
  // Whether it cannot go on yet, because it ran into a block, or with one, that may be a lead: no
  // block of the path may leave meanwhile.
  [[nodiscard]] bool waits_for_closing() const { return waits_for_closing_; }
  // The piece being walked; beyond the path where all of it has been walked.
  [[nodiscard]] const PathPiece& at() const { return at_; }
  // Whether the contour is known a whole window beyond the block.
  [[nodiscard]] bool has_had_its_window(std::size_t block) const {
    return number_of(block) + window_ < end_of_contour();
  }
  // To be called when places on the block have moved.
  void forget_passes_on(std::size_t block);

  // To be called after the path, the obstacles and the pieces walked.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(walking_, at_, tolerated_.from, tolerated_.until, tolerated_.nearness, passes_);
    if constexpr (Archive::is_loading::value) exact_from_ = walked_.end();
  }

 private:
  // Blocks of the path are counted from the start of the selection, contour blocks too.
  using Onset = Obstacles::Onset;
  using Nearness = Obstacles::Nearness;
  enum class Step { done, wait, stop };
  // How near the path may come, and up to where. The part before `from` has been examined.
  struct Tolerated {
    double from = 0;  // mm along the block of `until`
    PathPlace until{};
    Nearness nearness = Nearness::passable;
  };
  // A place where the walk could have left a loop out, and has not.
  struct Pass {
    std::size_t block = 0;
    LoopExit exit{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, exit.piece, exit.leaves, exit.continues, exit.point);
    }
  };

  bool set_out();
  void reconsider(std::size_t number, const Box& area, double farthest_reach);
  void walk_again_from(std::size_t piece, const Onset& onset);
  // After a new contour block: whether the path runs into it before the onset in waiting_with_.
  void keep_waiting();
  void drop_pieces(std::size_t kept);

  // Notes whether an onset in the block being walked has to wait until the closing is known.
  [[nodiscard]] bool is_undecided(const Onset& onset);
  // Acts on an onset in the block being walked.
  Step leave(const Onset& onset);
  Step leave_at_once(const Onset& onset);
  // The path has come within the tool's reach, but does not violate yet.
  void pass(const Onset& onset, const std::optional<LoopExit>& exit);
  // Tolerates the obstacle as long as the path stays within reach of it.
  void tolerate(const Onset& onset, Nearness nearness);
  // The block being walked is travelled backwards. Returns whether there is a way to leave it out.
  bool leave_backwards();
  // Where no exit leads on from a violation: goes back to the last pass whose loop holds it.
  bool leave_for_last_pass();
  // Whether the violation is too small to count.
  [[nodiscard]] bool counts_as_none(const Onset& violation);
  // Whether it would leave out a whole closed contour, which is no loop.
  [[nodiscard]] bool is_seam(const LoopExit& exit) const;
  void jump(const LoopExit& exit);
  void advance();
  // advance() for all blocks before this one.
  void advance_to(std::size_t block);
  // Keeps the part of the block walked so far as a piece.
  void keep_cut();
  bool refuse(const Onset& onset);
  // Whether part of the block being walked may come nearer than `Nearness::exact` allows.
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
  // Whether the contour is known `lead` blocks beyond the path block, or has ended.
  [[nodiscard]] bool is_known(std::size_t block, std::size_t lead) const {
    return ended_ || number_of(block) + lead < end_of_contour();
  }

  // The next onset that counts; loops that do not violate are passed over.
  [[nodiscard]] std::optional<Onset> next_onset() const;
  // Whether the corners leave nothing of the block, so that it is travelled backwards.
  [[nodiscard]] bool runs_backwards(std::size_t block) const;
  // Whether the loop between two places soon violates; the path enters the obstacle at its start.
  [[nodiscard]] bool violates_soon(const PathPlace& from, const PathPlace& to,
                                   std::size_t obstacle) const;

  const HeldPath& path_;
  Obstacles& obstacles_;
  WalkedPath& walked_;
  const ClosingWatch& closing_;
  std::size_t window_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;
  Seam seam_;
  LoopExits exits_;

  bool walking_ = false;
  bool ended_ = false;  // the contour has
  bool waits_for_closing_ = false;
  PathPiece at_{};
  Tolerated tolerated_{};
  std::vector<Pass> passes_;  // the last ones, whose loops the walk may still be in
  // For a window only: the first piece of, or after, the chain that ends with the last contour
  // block.
  std::size_t first_of_chain_ = 0;
  // For a window only: the pieces from this one on come no nearer than `Nearness::exact` allows.
  std::size_t exact_from_ = 0;
  // For a window only: where the block being walked runs into the last contour block, and into no
  // other before it. It cannot be resolved before more blocks come.
  std::optional<Onset> waiting_with_;
};

}  // namespace trc
