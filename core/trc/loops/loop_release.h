#pragma once

#include <cstddef>

#include "core/base/diagnostics.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"
#include "core/trc/path_block.h"
#include "core/trc/setup.h"
#include "core/trc/walls/left_out.h"

namespace trc {

// Puts out the walked part of a path, each block as it came or cut to the part that is travelled. A
// contour block that is left out is masked: it is noted (900213), and its technology words, and
// what it moves across the plane and in tracking axes, come out at the crossing.
class LoopRelease {
 public:
  // Consecutive blocks of path().
  struct Row {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  LoopRelease(const CompensatorSetup& setup, HeldPath& path, WalkedPath& walked,
              const Obstacles& obstacles, Diagnostics& diagnostics)
      : path_(path),
        walked_(walked),
        obstacles_(obstacles),
        window_(setup.limits.look_ahead_blocks),
        largest_masked_share_(setup.largest_masked_share),
        input_resolution_(setup.leads.input_resolution),
        diagnostics_(diagnostics) {}

  // A new selection begins.
  void begin();
  // For a window only: a contour block of that length, mm, has come.
  void note_contour_block(double length) { contour_length_ += length; }
  // For a window only: refuses a lap that is left out before the pieces before `end` (D-39).
  bool check_leaving(std::size_t end);
  // Refuses a contour most of which is lost in one loop, once it has been walked whole (D-39).
  bool check_left_out();

  // The first block that has neither left nor been left out.
  [[nodiscard]] std::size_t next() const { return next_; }
  // The pieces before `end`.
  void release_to(std::size_t end, PathBlocks& out);
  // A portion of them: up to the next block that leaves as it came, unless that is the first.
  void release_portion(PathBlocks& out) { release_to(end_of_portion(), out); }
  // Leaves out the rest after the last piece, at `place`, the end of the path.
  void leave_out_rest(const Point& place, PathBlocks& out);

  // The next blocks, up to `most`, that leave as they came: nothing comes out before them, and they
  // have no passive blocks.
  [[nodiscard]] Row next_as_they_came(std::size_t most) const;
  void have_left(std::size_t count);
  // The travelled part of the next block, where it is not the whole block, nothing comes out before
  // it and it has no passive blocks; else null.
  [[nodiscard]] const PathPiece* next_part() const;
  void part_has_left();
  // Skips a loop that is left out next, if nothing comes out in its place.
  void pass_by_without_trace();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(next_, left_to_, longest_left_out_, contour_length_, is_most_left_out_);
  }

 private:
  [[nodiscard, gnu::always_inline]] HeldPath::Block path(std::size_t block) const {
    return path_.block(block);
  }
  [[nodiscard]] std::size_t end_of_path() const { return path_.end(); }
  [[nodiscard]] std::size_t number_of(std::size_t block) const { return path_.number_of(block); }

  // Up to here the path has left or been left out.
  [[nodiscard]] PathPlace left_up_to() const {
    return left_to_.block + 1 == next_ ? left_to_ : PathPlace{next_, 0};
  }
  [[nodiscard]] bool next_stands_for_itself() const;
  [[nodiscard]] std::size_t end_of_portion() const;
  void release(std::size_t number, PathBlocks& out);
  void release_linear(std::size_t transition, PathBlocks& out);
  // Leaves out the blocks before `next` that are not travelled: a loop, at `place`.
  void pass_by(const PathPlace& next, const Point& place, PathBlocks& out);
  // The last contour block of those before `end`, else the first of them; there is at least one.
  [[nodiscard]] std::size_t last_dropped_before(std::size_t end) const;
  // Whether nothing comes out in their place.
  [[nodiscard]] bool leave_no_trace(std::size_t end) const;
  // Whether a tool at the place leaves less of the lines among these contour blocks than the
  // resolution of the input: that is not reported (D-44).
  [[nodiscard]] bool leaves_nothing_of(std::size_t first, std::size_t last,
                                       const Point& place) const;
  // Reports the stretch left out before the next place, at the point.
  void report_masked(const PathPlace& next, const Point& place);
  // The stretch left out between two places of the path next to a loop (D-39).
  [[nodiscard]] LeftOut left_out(const PathPlace& from, const PathPlace& to) const;
  // Length of all walls known, mm.
  [[nodiscard]] double length_of_walls() const;
  // Whether the stretch left out between them is more than local damage, whatever its share (D-39):
  // it includes a lap, a change of depth or a rapid motion.
  [[nodiscard]] bool holds_a_whole(const PathPlace& from, const PathPlace& to,
                                   const LeftOut& stretch) const;
  // holds_a_whole() as far as it can be seen without the closing of the contour.
  [[nodiscard]] bool goes_round(const PathPlace& from, const PathPlace& to,
                                const LeftOut& stretch) const;
  // Calls visit(from, to) for each stretch of the path left out before the pieces before `end`.
  template <class Visit>
  PathPlace visit_left_out(std::size_t end, const Visit& visit) const;
  // The turn of the walls along the stretch left out, to the left, rad.
  [[nodiscard]] double turn_of(const PathPlace& from, const PathPlace& to) const;
  // Whether the walls among these contour blocks go round a part of the workpiece, which a tool of
  // any size can reach.
  [[nodiscard]] bool go_round_a_part(std::size_t first, std::size_t last) const;
  // Whether one of the contour blocks is rapid, except the first and the last one of the path.
  [[nodiscard]] bool is_parted_by_rapid(std::size_t first, std::size_t end) const;

  HeldPath& path_;
  WalkedPath& walked_;
  const Obstacles& obstacles_;
  std::size_t window_;
  double largest_masked_share_;
  double input_resolution_;  // mm
  Diagnostics& diagnostics_;

  std::size_t next_ = 0;
  static constexpr PathPlace none_left{HeldPath::most_blocks, 0};
  PathPlace left_to_ = none_left;  // part of a block has left, up to here
  // For a window only: lengths of the path that has left, and of all contour blocks, mm.
  LeftOut longest_left_out_{};
  double contour_length_ = 0;
  bool is_most_left_out_ = false;  // of the walls
};

}  // namespace trc
