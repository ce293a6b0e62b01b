#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/verify/four_walls.h"
#include "core/verify/measured_path.h"
#include "core/verify/nearest.h"
#include "core/verify/wall_tree.h"

namespace trc::verify {

// Finds the walls that the pieces of one group of path are compared with. Pieces one after the
// other are near to the same walls: those are looked for together.
class NearWalls {
 public:
  static constexpr std::size_t most_of_group = 32;

  NearWalls(const MeasuredPath& held, const WallTree& tree, Checkpoint& checkpoint)
      : held_(held), tree_(tree), checkpoint_(checkpoint) {}

  // Forgets the group.
  void clear() { is_known_ = exist_ = false; }
  [[nodiscard]] bool are_known() const { return is_known_; }
  // Of a group of path, from `first` on and before `behind`, all walls nearer than `reach`, mm.
  void find(std::size_t first, std::size_t behind, double reach);
  // Else they are too many to be looked at for each piece.
  [[nodiscard]] bool are_worth_it() const { return exist_; }
  [[nodiscard]] std::size_t leaves() const { return exist_ ? leaves_.size() : 0; }
  // The path goes round in windings: what is near is also looked for by its distances from the
  // middle of all walls.
  [[nodiscard]] bool path_winds() const { return winds_; }

  // Calls `visit(block, wall, first)`, as WallTree does, for all walls found that may be nearer
  // than `reach()` to a piece of the group, in their order. What `reach` says may shrink on the
  // way.
  template <class Reach, class Visit>
  void for_each_near(std::size_t number, const MeasuredPiece& path, const Reach& reach,
                     const Visit& visit) const {
    const std::size_t place = number - first_;
    const Compared piece(path.piece);
    Reached reached = reached_by(place, reach());
    // The wall that it runs beside is near for sure.
    const ProgrammedPiece& own = held_.programmed()[path.programmed];
    const bool is_own_apart = own.is_contour && tree_.is_whole(own.number) &&
                              piece.is_apart_from(own.piece, reached.reach);
    const std::size_t told_apart = is_own_apart ? path.programmed : none;
    bool may_have_shrunk = false;
    const auto compare = [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
      if (piece.is_apart_from(wall, reached.reach)) return;
      visit(block, wall, first);
      may_have_shrunk = true;
    };
    for (const WallTree::FourLeaves& four : near_)
      for (FourWalls::Bits leaves = near(reached, four); leaves != 0; leaves &= leaves - 1) {
        const WallTree::Leaf& leaf =
            four.leaves[static_cast<std::size_t>(std::countr_zero(leaves))];
        tree_.for_each_of(leaf, near(reached, leaf.walls, leaf.rings), told_apart, compare);
        if (!std::exchange(may_have_shrunk, false)) continue;
        if (const double now = reach(); now != reached.reach) reached = reached_by(place, now);
      }
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  // All that counts as near to a piece of path.
  struct Reached {
    double reach;  // mm
    FourWalls::Surroundings around;
    FourRings::Surroundings between{};
  };
  [[nodiscard]] Reached reached_by(std::size_t place, double reach) const {
    Reached reached{.reach = reach,
                    .around = {pieces_[place / FourWalls::count], place % FourWalls::count, reach}};
    if (winds_) reached.between = {rings_[place], reach};
    return reached;
  }
  [[nodiscard]] FourWalls::Bits near(const Reached& reached, const FourWalls& walls,
                                     const FourRings& rings) const {
    const FourWalls::Bits between = winds_ ? rings.near(reached.between) : ~FourWalls::Bits{0};
    return between == 0 ? 0 : between & walls.near(reached.around);
  }
  [[nodiscard]] FourWalls::Bits near(const Reached& reached,
                                     const WallTree::FourLeaves& four) const {
    return winds_ && four.are_windings ? four.rings.near(reached.between)
                                       : near(reached, four.around, four.rings);
  }
  // Puts what lies around each piece to pieces_. Around all of them, along their way: that is a
  // narrow one.
  [[nodiscard]] Box box_of_group();
  // Between which distances from the middle of all walls the group lies.
  [[nodiscard]] Ring ring_of_group();

  const MeasuredPath& held_;
  const WallTree& tree_;
  Checkpoint& checkpoint_;
  bool is_known_ = false;
  bool exist_ = false;
  bool winds_ = false;
  std::size_t first_ = 0;
  std::size_t behind_ = 0;
  Point origin_ = Point::Zero();  // that coordinates count from: where the group begins
  std::array<FourWalls, most_of_group / FourWalls::count> pieces_;  // around the pieces
  std::array<Ring, most_of_group> rings_;  // where they wind: about the middle of all walls
  std::vector<std::size_t> leaves_;
  std::vector<WallTree::FourLeaves> near_;
};

}  // namespace trc::verify
