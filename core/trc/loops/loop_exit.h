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

// Where a loop of the path begins, in which travelled piece, and where it ends.
struct LoopExit {
  std::size_t piece = 0;  // its number; the end of what is walked: the piece being walked
  double leaves = 0;
  PathPlace continues{};
  Point point = Point::Zero();
};

// Looks for the way out of a loop: behind an onset the path has to cross what lies in the tool's
// reach of the obstacle, or of another one in the same place, farther on (core/doc/loop_removal.md,
// "Where it goes on").
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

  // `at`: the piece being walked, in whose block the onset is.
  // Exact: where the path has just come within the tool's reach. Passable: where it has been so for
  // a while, and the crossing may lie before.
  [[nodiscard]] std::optional<LoopExit> find(const PathPiece& at, const Onset& onset,
                                             Nearness nearness) const;

 private:
  // What can lie where an obstacle is, in blocks ahead: its own equidistant or, about
  // one of its ends, the transitions there and the equidistant of its neighbour.
  struct Stretch {
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
  // Whether the way from one block of the path to another one is none to be looked for now.
  [[nodiscard]] bool leaves_out_a_lap(std::size_t from, std::size_t to) const {
    const bool goes_round =
        within_lap_ && obstacles_.walls().goes_round(path_.number_of(from), path_.number_of(to));
    goes_round_ = goes_round_ || goes_round;
    return goes_round;
  }
  // Behind the block `at`.
  [[nodiscard]] Stretch stretch_about(std::size_t obstacle, std::size_t at) const;
  // How the path meets its continuation.
  enum class Kind { any, crossing, beside };
  // On the piece that ends with the onset.
  [[nodiscard]] std::optional<LoopExit> first_here(const PathPiece& piece,
                                                   const std::vector<std::size_t>& obstacles,
                                                   Kind kind, Nearness nearness) const;
  [[nodiscard]] std::optional<LoopExit> exit_here(const PathPiece& piece, std::size_t obstacle,
                                                  Kind kind, Nearness nearness) const;
  // Before it, in a point the path comes back to.
  [[nodiscard]] std::optional<LoopExit> exit_behind(const PathPiece& at, const Onset& onset) const;
  // Before it, where the path comes back with the rest of the block being walked: a circle that
  // ends where it begins.
  [[nodiscard]] std::optional<LoopExit> exit_behind_into_rest(const PathPiece& at,
                                                              const Onset& onset) const;
  // On it or before it, where the first walls, which lie behind the last ones, are in the way: the
  // lead-out is what leads on there.
  [[nodiscard]] std::optional<LoopExit> exit_by_lead_out(const PathPiece& piece,
                                                         const Onset& onset) const;
  // mm of these blocks; somewhat more than `most` where it is more.
  [[nodiscard]] double walls_between(std::size_t first, std::size_t end, double most) const;
  // The last crossing of what has been walked with the stretch, as in crossing_in().
  [[nodiscard]] std::optional<LoopExit> last_of_walked(const Onset& onset, const Stretch& stretch,
                                                       const PathPlace& least) const;
  // Asks about this piece from now on.
  void ask_about(const PathPiece& piece) const;
  // Those of the stretch that are so near to the piece asked about that they may have a point in
  // common: near_. Returns whether there is one.
  [[nodiscard]] bool has_near(const Stretch& stretch) const;
  // The last crossing of that piece, which has the number, with one of those, as near to the
  // obstacle as the radius. `least`: how far along those it is at least.
  [[nodiscard]] std::optional<LoopExit> crossing_in(const PathPiece& piece, std::size_t number,
                                                    std::size_t obstacle,
                                                    const PathPlace& least) const;
  [[nodiscard]] double place_not_before(double least, double along, std::size_t block) const;
  // Where a block of the path crosses another one; none where that one is not travelled. Obstacles
  // in the same place have neighbours in common: found once for each onset and block.
  [[nodiscard]] std::span<const Crossing> crossings_of(std::size_t block, std::size_t other) const;
  // Whether the point is farther than the radius from the contour block.
  [[nodiscard]] bool reaches_out(const HeldPath::ContourBlock& block, const Point& point) const;

  const HeldPath& path_;
  const WalkedPath& walked_;
  const Obstacles& obstacles_;
  Tolerances tolerances_;
  Checkpoint& checkpoint_;

  struct Known {
    std::size_t other = 0;
    Crossings crossings{};
  };
  // About the piece asked about, and how far from that what meets it may be.
  mutable bool within_lap_ = false;
  mutable bool goes_round_ = false;  // a way has been left aside for that
  mutable Box area_{};
  mutable double reach_ = 0;
  // Of one block; members for their memory's sake.
  mutable std::size_t known_of_ = HeldPath::most_blocks;
  mutable Track track_{Line{}};
  mutable bool has_length_ = false;
  mutable std::vector<Known> known_;
  mutable std::vector<std::size_t> near_;
};

}  // namespace trc
