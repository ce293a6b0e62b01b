#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/geometry/box_tree.h"
#include "core/trc/certificate.h"
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
// Holds such a selection as a whole; all else passes through at once.
class LoopRemoval {
 public:
  LoopRemoval(std::size_t selection_blocks, const Tolerances& tolerances, Diagnostics& diagnostics)
      : selection_blocks_(selection_blocks), tolerances_(tolerances), diagnostics_(diagnostics) {}

  bool feed(PathBlock block, std::vector<PathBlock>& out);
  bool drain(std::vector<PathBlock>& out) { return resolve(out); }
  // Of the selections it holds as a whole; nothing else.
  [[nodiscard]] std::size_t look_ahead() const { return 0; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_);
  }

 private:
  // A point of the path: how far along which held block.
  struct Place {
    std::size_t block = 0;
    double along = 0;  // mm from the start of its tool path

    bool operator<(const Place& other) const {
      return block != other.block ? block < other.block : along < other.along;
    }
  };
  // What is travelled of a held block, with ends shared with its neighbours.
  struct Piece {
    std::size_t block = 0;
    double from = 0;
    double to = 0;
    Point start = Point::Zero();
    Point end = Point::Zero();
    bool behind_loop = false;  // a loop was dropped before it
  };
  // Where the path comes too near to a contour block.
  struct Onset {
    double along = 0;
    std::size_t obstacle = 0;  // number of the contour block
  };
  // Where a loop begins, in which travelled piece, and where it ends.
  struct Exit {
    std::size_t piece = 0;  // number of pieces kept before it
    double leaves = 0;
    Place continues{};
    Point point = Point::Zero();
  };
  enum class Nearness { exact, passable };

  bool resolve(std::vector<PathBlock>& out);
  void survey();
  bool walk();
  // The rest of the block has a violation; what is done about it is in pieces_ and
  // at_. False: nothing can be.
  bool leave(const Onset& onset);
  void jump(const Exit& exit);
  void advance();

  [[nodiscard]] double reach(std::size_t block, Nearness nearness) const;
  [[nodiscard]] std::optional<Onset> onset(std::size_t block, double from, double to,
                                           Nearness nearness) const;
  // The onset that counts, with the loops that do not violate let pass.
  [[nodiscard]] std::optional<Onset> next_onset() const;
  [[nodiscard]] BoxTree::Range certified(std::size_t block) const;
  [[nodiscard]] std::optional<Exit> find_exit(const Onset& onset, Nearness nearness) const;
  [[nodiscard]] std::optional<Exit> crossing_in(const Piece& piece, std::size_t number,
                                                std::size_t first, std::size_t last) const;
  [[nodiscard]] bool violates(const Place& from, const Place& to) const;

  void emit(std::vector<PathBlock>& out);
  void report_masked(std::size_t first, std::size_t last, const Point& place);
  bool refuse(const Onset& onset);

  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;

  std::vector<PathBlock> held_;
  std::size_t first_ = 0;                    // held block the compensated path begins with
  std::vector<std::size_t> contour_;         // held contour blocks
  std::vector<std::size_t> contour_number_;  // of each held block, or of the one before it
  std::vector<double> radius_;               // tool radius of each held block
  std::optional<BoxTree> boxes_;             // of the programmed contour
  std::optional<Certificate> certificate_;

  std::vector<Piece> pieces_;
  Piece at_{};             // the piece being walked
  Place tolerated_{};      // up to here the path is in a loop that does not violate
  std::size_t clear_ = 0;  // held blocks before this one are known to be clear
};

}  // namespace trc
