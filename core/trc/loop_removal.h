#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/numbered_queue.h"
#include "core/base/tolerances.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/trc/certificate.h"
#include "core/trc/held_path.h"
#include "core/trc/path_block.h"

namespace trc {

// G141 with REMOVE_MASKED_BLOCKS: takes every violating loop out of the path of a
// selection (spec 5.1), however many blocks it has.
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
  // `window` in contour blocks; 0: the whole selection.
  LoopRemoval(std::size_t window, std::size_t selection_blocks, const Tolerances& tolerances,
              Diagnostics& diagnostics, Checkpoint& checkpoint)
      : window_(window),
        selection_blocks_(selection_blocks),
        tolerances_(tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        certificate_(tolerances) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return !is_holding() && !leaving_ && !block.removes_loops();
  }
  // A selection that has ended leaves in portions, so that it does not lie in the vectors
  // between all passes at once. What is fed meanwhile waits behind it.
  [[nodiscard]] bool is_leaving() const { return leaving_; }
  bool let_go_some(PathBlocks& out);
  // The same for the next block alone, if it leaves as it came: with nothing before it and nothing
  // about it. `block` is as in HeldPath::restore.
  bool let_go_next(PathBlock& block);

  // The middle of a contour is being held: ContourRun may give it more of it.
  [[nodiscard]] bool takes_contour() const { return !leaving_ && end_of_contour() > 0; }
  // A contour block or a transition. Returns false once the stream must stop.
  bool take(PathBlock& block, PathBlocks& out) {
    return hold(block) && (window_ == 0 || proceed(out));
  }

  [[nodiscard]] std::size_t look_ahead() const { return window_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(entering_, path_, largest_radius_, apart_, certificate_, walking_, pieces_, cuts_, at_,
            tolerated_, next_);
    rebuild_boxes();
  }

 private:
  // Blocks of the path are counted from the begin of the selection, contour blocks too.
  // A point of the path: how far along which block.
  struct Place {
    std::size_t block = 0;
    double along = 0;  // mm from the start of its tool path

    bool operator<(const Place& other) const {
      return block != other.block ? block < other.block : along < other.along;
    }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, along);
    }
  };
  // What is travelled of a block, with ends shared with its neighbours.
  struct Piece {
    std::size_t block = 0;
    double from = 0;
    double to = 0;
    Point start = Point::Zero();
    Point end = Point::Zero();
    bool behind_loop = false;          // a loop was dropped before it
    Vector arrives = Vector::UnitX();  // the direction of travel into the loop

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, from, to, start, end, behind_loop, arrives);
    }
  };
  // A piece as it is kept: most are whole blocks.
  struct Kept {
    static constexpr HeldPath::Number whole = HeldPath::most_blocks;
    HeldPath::Number block = 0;
    HeldPath::Number cut = whole;  // which one of cuts_

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, cut);
    }
  };
  // Where the path comes too near to a contour block.
  struct Onset {
    double along = 0;
    std::size_t obstacle = 0;  // its number
  };
  // Where a loop begins, in which travelled piece, and where it ends.
  struct Exit {
    std::size_t piece = 0;  // its number
    double leaves = 0;
    Place continues{};
    Point point = Point::Zero();
  };
  // What can lie where an obstacle is, in blocks ahead: its own equidistant or, about
  // one of its ends, the transitions there and the equidistant of its neighbour.
  struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
  };
  enum class Nearness { exact, passable };
  enum class Step { done, wait, stop };

  [[nodiscard]] bool is_holding() const { return !entering_.empty() || !path_.blocks().empty(); }
  void begin_selection();
  bool end_selection();
  bool hold(PathBlock& block);
  [[nodiscard]] bool has_room_for(const PathBlock& block);
  void note_contour_block(const PathBlock& block);
  void reconsider(std::size_t number, const Box& area);
  void rebuild_boxes();
  void keep_cut();
  void drop_pieces(std::size_t kept);
  bool proceed(PathBlocks& out);
  void forget();

  // As far as the contour is known well enough; all the way when it has ended.
  bool walk(bool ended);
  bool begin_walk(bool ended);
  // What to do about an onset in the block being walked.
  Step leave(const Onset& onset, bool ended);
  void jump(const Exit& exit);
  void advance();

  [[nodiscard]] const HeldPath::Block& path(std::size_t block) const {
    return path_.blocks()[block];
  }
  [[nodiscard]] const HeldPath::ContourBlock& contour(std::size_t number) const {
    return path_.contour()[number];
  }
  [[nodiscard]] std::size_t end_of_path() const { return path_.blocks().end(); }
  [[nodiscard]] std::size_t end_of_contour() const { return path_.contour().end(); }
  [[nodiscard]] std::size_t number_of(std::size_t block) const { return path(block).number; }
  [[nodiscard]] Piece piece(std::size_t number) const;
  // Whether the contour is known `lead` blocks beyond the path block.
  [[nodiscard]] bool is_known(std::size_t block, std::size_t lead, bool ended) const;

  [[nodiscard]] double part_of(Nearness nearness) const;
  [[nodiscard]] double reach(std::size_t block, Nearness nearness) const;
  // All contour blocks it may come nearer to than `limit`: neighbours_.
  void find_neighbours(std::size_t block, double limit) const;
  [[nodiscard]] bool are_many() const { return neighbours_.size() > 4; }
  // Drops those of them that are not within the limit anywhere on it. Returns the nearest one to
  // its middle, where it is nearer than the limit.
  std::optional<std::size_t> drop_those_off(const PathPart& part, double limit) const;
  [[nodiscard]] std::optional<Onset> onset(std::size_t block, double from, double to,
                                           Nearness nearness) const;
  // Whether there is one.
  [[nodiscard]] bool comes_nearer(std::size_t block, double from, double to,
                                  Nearness nearness) const;
  // The onset that counts, with the loops that do not violate let pass.
  [[nodiscard]] std::optional<Onset> next_onset(bool ended);
  void survey();
  [[nodiscard]] BoxTree::Range certified(std::size_t block) const;
  [[nodiscard]] std::optional<Exit> find_exit(const Onset& onset, Nearness nearness) const;
  // The numbers of all contour blocks that are as near there as the one of the
  // onset: the other block of a corner, blocks on top of each other.
  [[nodiscard]] std::vector<std::size_t> obstacles_at(const Onset& onset, Nearness nearness) const;
  [[nodiscard]] Stretch stretch_about(std::size_t obstacle) const;
  // On the block being walked.
  [[nodiscard]] std::optional<Exit> exit_here(const Onset& onset, Nearness nearness) const;
  // Before it, where the path has crossed a transition that reaches out of the tool
  // radius already.
  [[nodiscard]] std::optional<Exit> exit_behind(const Onset& onset) const;
  // The last crossing with what lies where the obstacle is. `beside`: from the piece to
  // the onset the path is as near to the obstacle as the radius; else only a mitre can
  // be crossed.
  [[nodiscard]] std::optional<Exit> crossing_in(const Piece& piece, std::size_t number,
                                                std::size_t obstacle, bool beside) const;
  // Whether nothing in one box can be within reach of anything in the other.
  [[nodiscard]] bool are_apart(const Box& one, const Box& other, double reach) const;
  // Whether the point is farther than the radius from the contour block.
  [[nodiscard]] bool reaches_out(const HeldPath::ContourBlock& block, const Point& point) const;
  // Nothing is left between the corners of the block: it is travelled backwards.
  [[nodiscard]] bool runs_backwards(std::size_t block) const;
  // Whether the loop between two places does; it begins where the path enters the obstacle.
  [[nodiscard]] bool violates(const Place& from, const Place& to, std::size_t obstacle) const;

  void let_go_to(std::size_t end, PathBlocks& out);
  void let_go(std::size_t number, PathBlocks& out);
  // The blocks before `end` that are not travelled: a loop, left out at `place`.
  void pass_by(std::size_t end, const Point& place, PathBlocks& out);
  void report_masked(std::size_t first, std::size_t last, const Point& place);
  bool refuse(const Onset& onset);

  std::size_t window_;
  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;

  PathBlocks entering_;  // the approach, which leaves with the first block of the path
  HeldPath path_;
  double largest_radius_ = 0;
  BoxTree boxes_;       // of the contour
  bool apart_ = false;  // the next contour block does not meet the last one
  Certificate certificate_;

  // Walked, and still here.
  NumberedQueue<Kept> pieces_;
  NumberedQueue<Piece> cuts_;  // those that are not whole blocks
  // For a window only: the first piece of, or behind, the chain that ends with the last contour
  // block, and of all pieces.
  std::size_t first_of_chain_ = 0;
  BoxTree piece_boxes_;
  bool walking_ = false;
  Piece at_{};            // the piece being walked
  Place tolerated_{};     // up to here the path is in a loop that does not violate
  std::size_t next_ = 0;  // the first block that has neither left nor been dropped

  bool leaving_ = false;
  PathBlocks behind_;
  bool ended_ = false;  // nothing comes behind that

  // A stretch of the path, and all contour blocks that may be near one of its blocks.
  Stretch surveyed_{};
  NumberedBoxes near_;
  mutable std::vector<std::size_t> neighbours_;  // a member for its memory's sake
};

}  // namespace trc
