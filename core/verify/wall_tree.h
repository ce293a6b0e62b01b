#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/trc/walls/sided_walls.h"
#include "core/verify/four_walls.h"
#include "core/verify/measured_path.h"

namespace trc::verify {

// A piece of path that is compared with walls, with what bounds it.
struct Probe {
  explicit Probe(const Piece& path)
      : piece(path), box(box_of(path)), ring(path.is_arc() ? ring_of(path, path.center) : Ring{}) {}

  Piece piece{};
  Box box{};
  Ring ring{};          // of an arc, about its own centre
  Ring about_middle{};  // of all walls
};

// Finds the walls near to a piece of path. Neighbours in the program are neighbours in the plane:
// a node holds a stretch of the contour in a box that lies as the stretch does, so that neither
// slanted nor parallel walls are all near to one another. Concentric walls are told apart by rings,
// which are made when they are asked for first.
class WallTree {
 public:
  // Over the walls among the pieces from `begin` to `end` of one selection, which must not change.
  WallTree(const MeasuredPath& held, std::size_t begin, std::size_t end, const SidedWalls& sides,
           Checkpoint& checkpoint);

  // Goes over to the same walls in another path that is held, where they may require something
  // else: pieces from `begin` on that are what its own are, as far as walls go.
  void move_to(const MeasuredPath& held, std::size_t begin, Checkpoint& checkpoint);

  // A piece of path to be compared.
  [[nodiscard]] Probe probe(const Piece& path) const {
    Probe made(path);
    if (!own_rings_.empty()) made.about_middle = about_middle(path);
    return made;
  }

  // What tells windings apart is made when it is needed first: before anything is asked about the
  // middle of all walls, and before single pieces are compared with many of them.
  void make_rings(Checkpoint& checkpoint) const;
  void make_own_rings(Checkpoint& checkpoint) const;

  // The place in the tree of a stretch of the contour.
  struct NodePlace {
    std::size_t level = 0;
    std::size_t index = 0;
  };
  // No more of them are worth being looked at for each piece of path.
  static constexpr std::size_t most_leaves = 64;
  // Nor are they worth being looked for longer.
  static constexpr std::size_t most_nodes = 8 * most_leaves;
  // The leaves that may be nearer to the box than `reach`, in their order, for several pieces of
  // path there; some that lie beside such a leaf are among them. False: they are too many.
  bool find_near(const Box& box, double reach, std::vector<std::size_t>& found) const;
  // The leaves that may be nearer than `reach` to what is both in the box and in the ring, which is
  // about the middle of all walls; else as above.
  bool find_near(const Box& box, const Ring& about_middle, double reach,
                 std::vector<std::size_t>& found) const;
  [[nodiscard]] Ring about_middle(const Piece& path) const { return ring_of(path, rings_.middle); }

  // Calls `visit(block, wall, first)` for all walls that may be nearer than
  // `reach(required)`, where `required` is what the wall, or any of those in a node, asks for; the
  // nearest ones early. What `reach` says may shrink on the way. Of walls that are the same, lap by
  // lap, only the last one is visited, which is one for the path of all laps before it; `first` is
  // the contour block of the first.
  template <class Reach, class Visit>
  void for_each_near(const Probe& probe, const Reach& reach, const Visit& visit) const {
    // Without initial values: most of them are never looked at.
    struct Open {
      std::size_t level;
      std::size_t index;
      double gap;
    };
    // Of each level one node waits for its sibling.
    std::array<Open, 2 * most_levels> open;
    const auto see = [&](const NodePlace& stretch) {
      return Open{.level = stretch.level,
                  .index = stretch.index,
                  .gap = gap_of(probe, stretch, reach(node_at(stretch).required))};
    };
    std::size_t count = 0;
    open[count++] = see(whole());
    while (count > 0) {
      const Open next = open[--count];
      const auto [level, index, gap] = next;
      if (!(gap < reach(node_at({.level = level, .index = index}).required))) continue;
      if (level == 0) {
        visit_bucket(index, visit);
        continue;
      }
      Open left = see({level - 1, 2 * index});
      if (2 * index + 1 < levels_[level - 1].size) {
        Open right = see({level - 1, 2 * index + 1});
        if (right.gap < left.gap) std::swap(left, right);
        open[count++] = right;
      }
      open[count++] = left;
    }
  }

  // The walls of a leaf, side by side, and of up to four leaves what lies around each, all seen
  // from one origin.
  struct Leaf {
    std::size_t index = 0;
    FourWalls walls{};
    FourRings rings{};  // about the middle of all walls; only where they are asked for
  };
  struct FourLeaves {
    FourWalls around{};
    FourRings rings{};
    std::array<Leaf, FourWalls::count> leaves;
    bool are_windings = true;  // whole ones: `around` is near to all that is within
  };
  // Places those found at the end of `near`, four by four.
  void gather(const std::vector<std::size_t>& found, const Point& origin, bool with_rings,
              std::vector<FourLeaves>& near) const;
  // Calls `visit(block, wall, first)`, as for_each_near() does, for some walls of the leaf, but for
  // one programmed piece.
  template <class Visit>
  void for_each_of(const Leaf& leaf, FourWalls::Bits wanted, std::size_t unwanted,
                   const Visit& visit) const {
    for (; wanted != 0; wanted &= wanted - 1) {
      const std::size_t number =
          begin_ + leaf.index * bucket_size + static_cast<std::size_t>(std::countr_zero(wanted));
      if (number < end_ && number != unwanted) visit_wall(number, visit);
    }
  }

  // Whether all contour blocks are walls from end to end.
  [[nodiscard]] bool are_whole() const { return !has_special_; }
  // Whether all of a contour block is a wall.
  [[nodiscard]] bool is_whole(std::size_t number) const {
    return !has_special_ || !special_[number];
  }

  // Of a tree over so many pieces.
  [[nodiscard]] static std::size_t bytes_for(std::size_t pieces) {
    return (sizeof(Node) + 2 * sizeof(Ring)) * (2 * (pieces / bucket_size) + most_levels) +
           (sizeof(KeptLeaf) + sizeof(FourRings)) * (pieces / bucket_size + 1) +
           sizeof(FourWalls) * (pieces / (3 * bucket_size) + most_levels) +
           pieces * (2 * sizeof(std::size_t) + sizeof(std::uint32_t));
  }

 private:
  static constexpr std::size_t bucket_size = FourWalls::count;  // pieces of a leaf
  static constexpr std::size_t most_levels = 48;
  // Shorter arcs lie in boxes thin enough, and turn about no centre of their own.
  static constexpr double long_sweep = 0.5;  // rad

  struct Node {
    Box box{};
    double required = -1;  // the largest of its walls; negative: it has none
  };
  struct KeptLeaf {
    Point origin = Point::Zero();
    FourWalls walls{};
  };
  // What tells concentric walls apart: about the middle of all walls.
  struct Rings {
    Point middle = Point::Zero();
    std::vector<Ring> nodes{};  // as the nodes of the tree
    std::vector<FourRings> leaves{};
  };
  struct Level {
    std::size_t first = 0;  // of the nodes
    std::size_t size = 0;
    std::size_t first_four = 0;  // of every other level, from the third on
  };

  [[nodiscard]] NodePlace whole() const { return {.level = levels_.size() - 1}; }
  [[nodiscard]] std::size_t place_of(const NodePlace& stretch) const {
    return levels_[stretch.level].first + stretch.index;
  }
  [[nodiscard]] const Node& node_at(const NodePlace& stretch) const {
    return nodes_[place_of(stretch)];
  }
  // Only whether it is below `reach` need be right.
  [[nodiscard]] double gap_of(const Probe& probe, const NodePlace& stretch, double reach) const;
  template <class Visit>
  void visit_bucket(std::size_t index, const Visit& visit) const {
    const std::size_t first = begin_ + index * bucket_size;
    const std::size_t behind = std::min(first + bucket_size, end_);
    for (std::size_t number = first; number < behind; ++number) visit_wall(number, visit);
  }
  // With what of the block is a wall.
  template <class Visit>
  void visit_wall(std::size_t number, const Visit& visit) const {
    const ProgrammedPiece& block = held_->programmed()[number];
    if (!block.is_contour) return;
    const std::uint32_t first = first_.empty() ? block.number : first_[number - begin_];
    if (first == hidden) return;
    if (is_whole(block.number)) return visit(block, block.piece, first);
    if (!sides_.is_lead(block.number))
      visit(block, piece_of(sides_.wall(block.number, segment_of(block.piece))), first);
  }
  void find_special();
  // Laps on top of each other would make every wall as many as there are laps.
  void hide_copies(Checkpoint& checkpoint);
  [[nodiscard]] Point find_middle(Checkpoint& checkpoint) const;
  void build_buckets(Checkpoint& checkpoint);
  void build_level(const Level& below, Checkpoint& checkpoint);
  void build_fours(Checkpoint& checkpoint);
  // With walls in it.
  void add_leaf(std::size_t index, std::vector<std::size_t>& found) const {
    if (nodes_[index].required >= 0) found.push_back(index);
  }
  // Of two leaves beside each other, where they are as near to the box as that.
  void add_near(const NodePlace& both, const Box& box, double reach,
                std::vector<std::size_t>& found) const;
  [[nodiscard]] Ring ring_of_bucket(std::size_t index, FourRings& leaf,
                                    Checkpoint& checkpoint) const;
  [[nodiscard]] Ring own_ring_of_bucket(std::size_t index) const;
  // Level by level, as the nodes: of buckets, and of two nodes that both have walls.
  template <class OfBucket, class OfBoth>
  [[nodiscard]] std::vector<Ring> rings_of_nodes(const OfBucket& of_bucket, const OfBoth& of_both,
                                                 Checkpoint& checkpoint) const;
  // What the walls of each node require, and nothing else of it.
  void find_required(Checkpoint& checkpoint);

  const MeasuredPath* held_;
  std::size_t begin_;
  std::size_t end_;
  const SidedWalls& sides_;
  // Blocks that are not walls from end to end; none: not kept.
  std::vector<bool> special_;
  bool has_special_ = false;
  // For each piece the first of those like it, as a contour block; none: no wall is there twice.
  std::vector<std::uint32_t> first_;
  static constexpr std::uint32_t hidden = std::numeric_limits<std::uint32_t>::max();
  std::vector<Node> nodes_;  // level by level, buckets first
  std::vector<Level> levels_;
  std::vector<KeptLeaf> leaves_;
  // For each node of every other level what lies around the nodes two levels below: most of what is
  // far away is told apart from a group of path four at a time.
  std::vector<FourWalls> fours_;
  Point origin_ = Point::Zero();         // that these count from
  mutable Rings rings_;                  // empty: nobody has asked for them
  mutable std::vector<Ring> own_rings_;  // about an arc's own centre, or about the middle
};

}  // namespace trc::verify
