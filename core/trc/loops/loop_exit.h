#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/geometry/track.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"

namespace trc {

// Where a loop of the path begins, with the travelled piece, and where it ends.
struct LoopExit {
  std::size_t piece = 0;  // its number; the end of what is walked: the piece being walked
  double leaves = 0;
  PathPlace continues{};
  Point point = Point::Zero();
};

// Looks for the way out of a loop: after an onset the path must cross a later part of itself near
// the obstacle, or near another one in the same place (core/doc/loop_removal.md, "Where it goes
// on").
class LoopExits {
 public:
  using Nearness = Obstacles::Nearness;
  using Onset = Obstacles::Onset;

  LoopExits(const HeldPath& path, const WalkedPath& walked, const Obstacles& obstacles,
            const Tolerances& tolerances, Checkpoint& checkpoint)
      : path_(path),
        walked_(walked),
        obstacles_(obstacles),
        tolerances_(tolerances),
        checkpoint_(checkpoint) {}

  // `at`: the piece being walked, in whose block the onset is. Exact: at the place where the path
  // has just come within the tool's reach. Passable: it has been within reach for some way, and the
  // crossing may lie before.
  [[nodiscard]] std::optional<LoopExit> find(const PathPiece& at, const Onset& onset,
                                             Nearness nearness) const;

 private:
  // The blocks ahead that can lie at an obstacle: its own equidistant or, about one of its ends,
  // the transitions there and the equidistant of its neighbour.
  struct BlocksAtObstacle {
    std::size_t first = 0;
    std::size_t end = 0;
    bool holds_leads = false;
  };

  [[nodiscard, gnu::always_inline]] HeldPath::Block path(std::size_t block) const {
    return path_.block(block);
  }
  [[nodiscard, gnu::always_inline]] HeldPath::ContourBlock contour(std::size_t number) const {
    return path_.contour_block(number);
  }
  [[nodiscard]] std::size_t end_of_contour() const { return path_.end_of_contour(); }

  [[nodiscard]] std::optional<LoopExit> find_any(const PathPiece& at, const Onset& onset,
                                                 Nearness nearness) const;
  // Whether exits from one block of the path to another one do not count now.
  [[nodiscard]] bool is_ignored(std::size_t from, std::size_t to) const;
  // Those at an obstacle, after the block `at`.
  [[nodiscard]] BlocksAtObstacle blocks_at(std::size_t obstacle, std::size_t at) const;
  // How the path meets the part where it goes on.
  enum class Kind { any, crossing, beside };
  // An exit on the piece that ends with the onset.
  [[nodiscard]] std::optional<LoopExit> first_here(const PathPiece& piece,
                                                   const std::vector<std::size_t>& obstacles,
                                                   Kind kind, Nearness nearness) const;
  [[nodiscard]] std::optional<LoopExit> exit_here(const PathPiece& piece, std::size_t obstacle,
                                                  Kind kind, Nearness nearness) const;
  // An exit before it, in a point that the path comes back to.
  [[nodiscard]] std::optional<LoopExit> exit_behind(const PathPiece& at, const Onset& onset) const;
  // An exit before it, where the rest of the block being walked leads back: a circle that ends
  // where it begins.
  [[nodiscard]] std::optional<LoopExit> exit_behind_into_rest(const PathPiece& at,
                                                              const Onset& onset) const;
  // An exit on it or before it, where the first walls, which lie after the last ones, are in the
  // way: there the path goes on along the lead-out.
  [[nodiscard]] std::optional<LoopExit> exit_by_lead_out(const PathPiece& piece,
                                                         const Onset& onset) const;
  // Length of the walls in these blocks, mm; counting stops somewhat above `most`.
  [[nodiscard]] double walls_between(std::size_t first, std::size_t end, double most) const;
  // The last crossing of the walked path with these blocks, as in crossing_in().
  [[nodiscard]] std::optional<LoopExit> last_of_walked(const Onset& onset,
                                                       const BlocksAtObstacle& blocks,
                                                       const PathPlace& least) const;
  // Asks about this piece from now on.
  void ask_about(const PathPiece& piece) const;
  // Puts into near_ the blocks of `blocks` that are near enough to the piece asked about to have
  // a point in common. Returns whether there is one.
  [[nodiscard]] bool has_near(const BlocksAtObstacle& blocks) const;
  // The last crossing of that piece, which has this number, with one of near_, no farther from the
  // obstacle than the radius. `least`: the least way along those.
  [[nodiscard]] std::optional<LoopExit> crossing_in(const PathPiece& piece, std::size_t number,
                                                    std::size_t obstacle,
                                                    const PathPlace& least) const;
  [[nodiscard]] double place_not_before(double least, double along, std::size_t block) const;
  // Where a block of the path crosses another one; none where that one is not travelled. Obstacles
  // in the same place share neighbours, so crossings are found once per onset and block.
  [[nodiscard]] std::span<const Crossing> crossings_of(std::size_t block, std::size_t other) const;
  // Whether the point is farther than the radius from the contour block.
  [[nodiscard]] bool reaches_out(const HeldPath::ContourBlock& block, const Point& point) const;

  const HeldPath& path_;
  const WalkedPath& walked_;
  const Obstacles& obstacles_;
  Tolerances tolerances_;
  Checkpoint& checkpoint_;

  // Exits that leave out a whole lap do not count at first; it is noted whether there was one.
  enum class ExitsOverLaps { none_ignored, ignored, allowed };
  // About a piece: a box, and the largest distance from it of blocks that may meet the piece.
  struct Asked {
    Box area{};
    double reach = 0;
  };
  struct Known {
    std::size_t other = 0;
    Crossings crossings{};
  };
  struct CrossingsOf {
    std::size_t block = 0;
    std::optional<Track> track{};  // none: without radius the block crosses nothing
  };
  mutable ExitsOverLaps exits_over_laps_ = ExitsOverLaps::none_ignored;
  mutable Asked asked_{};
  mutable std::optional<CrossingsOf> crossings_of_;
  // What is known of that block, and the blocks near the piece; members, so that their memory is
  // used again.
  mutable std::vector<Known> known_;
  mutable std::vector<std::size_t> near_;
};

}  // namespace trc
