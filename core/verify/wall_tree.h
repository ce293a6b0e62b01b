#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/verify/held_path.h"

namespace trc::verify {

// A piece of path that is compared with walls, with what bounds it.
struct Probe {
  explicit Probe(const Piece& path)
      : piece(path), box(box_of(path)), ring(path.is_arc() ? ring_of(path, path.center) : Ring{}) {}

  Piece piece;
  Box box;
  Ring ring;  // of an arc, about its own centre
};

// Finds the walls near to a piece of path. Neighbours in the program are neighbours in the plane:
// a node holds a stretch of the contour in a box that lies as the stretch does, and in a ring, so
// that neither slanted nor parallel nor concentric walls are all near to one another.
class WallTree {
 public:
  // Over the walls among the pieces from `begin` to `end`, which must not change.
  WallTree(const HeldPath& held, std::size_t begin, std::size_t end, Checkpoint& checkpoint);

  [[nodiscard]] std::size_t walls() const { return walls_; }

  // Calls `visit(wall)` for all walls that may be nearer than `reach(required)`, where `required`
  // is what the wall, or any of those in a node, asks for; the nearest ones early. What `reach`
  // says may shrink on the way.
  template <class Reach, class Visit>
  void for_each_near(const Probe& probe, const Reach& reach, const Visit& visit) const {
    struct Open {
      std::size_t level = 0;
      std::size_t index = 0;
      double gap = 0;
    };
    // Of each level one node waits for its sibling.
    std::array<Open, 2 * most_levels> open;
    std::size_t count = 0;
    open[count++] = {.level = levels_.size() - 1};
    while (count > 0) {
      const Open next = open[--count];
      const Node& node = node_at(next.level, next.index);
      if (!(next.gap < reach(node.required))) continue;
      if (next.level == 0) {
        visit_bucket(next.index, visit);
        continue;
      }
      Open left{.level = next.level - 1, .index = 2 * next.index};
      Open right{.level = left.level, .index = left.index + 1};
      left.gap = gap_of(probe, left.level, left.index);
      if (right.index < levels_[right.level].size) {
        right.gap = gap_of(probe, right.level, right.index);
        if (right.gap < left.gap) std::swap(left, right);
        open[count++] = right;
      }
      open[count++] = left;
    }
  }

  // Of a tree over so many pieces.
  [[nodiscard]] static std::size_t bytes_for(std::size_t pieces) {
    return (sizeof(Node) + sizeof(Ring)) * (2 * (pieces / bucket_size) + most_levels);
  }

 private:
  static constexpr std::size_t bucket_size = 4;  // pieces of a leaf
  static constexpr std::size_t most_levels = 48;

  struct Node {
    Box box{};
    double required = -1;  // the largest of its walls; negative: it has none
  };
  struct Level {
    std::size_t first = 0;  // of the nodes
    std::size_t size = 0;
  };

  [[nodiscard]] const Node& node_at(std::size_t level, std::size_t index) const {
    return nodes_[levels_[level].first + index];
  }
  [[nodiscard]] double gap_of(const Probe& probe, std::size_t level, std::size_t index) const;
  template <class Visit>
  void visit_bucket(std::size_t index, const Visit& visit) const {
    const std::size_t first = begin_ + index * bucket_size;
    const std::size_t behind = std::min(first + bucket_size, end_);
    for (std::size_t number = first; number < behind; ++number)
      if (const ProgrammedPiece& wall = held_.programmed()[number]; wall.is_wall) visit(wall);
  }
  void build_buckets(Checkpoint& checkpoint);
  void build_level(const Level& below, Checkpoint& checkpoint);
  [[nodiscard]] Ring ring_around(std::size_t a, std::size_t b) const;

  const HeldPath& held_;
  std::size_t begin_;
  std::size_t end_;
  std::size_t walls_ = 0;
  bool has_rings_ = false;
  std::vector<Node> nodes_;  // level by level, buckets first
  std::vector<Ring> rings_;  // of the nodes, where arcs are long enough to need them
  std::vector<Level> levels_;
};

}  // namespace trc::verify
