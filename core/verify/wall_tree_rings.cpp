#include <algorithm>
#include <array>
#include <cmath>

#include "core/verify/wall_tree.h"

// The rings of the tree, which tell concentric walls apart.

namespace trc::verify {
namespace {

// The ring about another centre, for walls that lie in both the box and the ring.
Ring seen_from(const Point& center, const Box& box, const Ring& ring) {
  Ring seen = ring_of(box, center);
  const double apart = (ring.center - center).norm();
  seen.inner = std::max({seen.inner, ring.inner - apart, apart - ring.outer});
  seen.outer = std::min(seen.outer, ring.outer + apart);
  return seen;
}

}  // namespace

template <class OfBucket, class OfBoth>
std::vector<Ring> WallTree::rings_of_nodes(const OfBucket& of_bucket, const OfBoth& of_both,
                                           Checkpoint& checkpoint) const {
  std::vector<Ring> rings;
  rings.reserve(nodes_.size());
  for (std::size_t index = 0; index < levels_.front().size; ++index)
    rings.push_back(of_bucket(index));
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const Level& below = levels_[level - 1];
    for (std::size_t first = below.first; first < below.first + below.size; first += 2) {
      checkpoint.pass();
      const std::size_t second = first + 1;
      if (second == below.first + below.size || nodes_[second].required < 0)
        rings.push_back(Ring(rings[first]));
      else if (nodes_[first].required < 0)
        rings.push_back(Ring(rings[second]));
      else
        rings.push_back(of_both(rings, first, second));
    }
  }
  return rings;
}

void WallTree::make_rings(Checkpoint& checkpoint) const {
  if (!rings_.nodes.empty()) return;
  rings_.middle = find_middle(checkpoint);
  rings_.leaves.reserve(leaves_.size());
  rings_.nodes = rings_of_nodes(
      [&](std::size_t index) {
        return ring_of_bucket(index, rings_.leaves.emplace_back(), checkpoint);
      },
      [](const std::vector<Ring>& rings, std::size_t first, std::size_t second) {
        return around(rings[first], rings[second]);
      },
      checkpoint);
}

Ring WallTree::ring_of_bucket(std::size_t index, FourRings& leaf, Checkpoint& checkpoint) const {
  Ring ring;
  const std::size_t first = begin_ + index * bucket_size;
  for (std::size_t place = 0; place < bucket_size && first + place < end_; ++place)
    visit_wall(first + place, [&](const ProgrammedPiece&, const Piece& wall, std::size_t) {
      checkpoint.pass();
      const Ring of_wall = about_middle(wall);
      leaf.set(place, of_wall);
      ring = ring.exists() ? around(ring, of_wall) : of_wall;
    });
  return ring;
}

void WallTree::make_own_rings(Checkpoint& checkpoint) const {
  if (!own_rings_.empty()) return;
  make_rings(checkpoint);
  own_rings_ = rings_of_nodes(
      [&](std::size_t index) {
        checkpoint.pass();
        return own_ring_of_bucket(index);
      },
      // About the centre of one of the two, whichever ring is narrower.
      [&](const std::vector<Ring>& rings, std::size_t first, std::size_t second) {
        const Ring& a = rings[first];
        const Ring& b = rings[second];
        if (a.center == b.center) return around(a, b);
        Ring narrowest;
        for (const Point& center : {a.center, b.center}) {
          const Ring ring = around(seen_from(center, nodes_[first].box, a),
                                   seen_from(center, nodes_[second].box, b));
          if (!narrowest.exists() || ring.outer - ring.inner < narrowest.outer - narrowest.inner)
            narrowest = ring;
        }
        return narrowest;
      },
      checkpoint);
}

// Walls with a long arc among them get a ring about the centre of that arc.
Ring WallTree::own_ring_of_bucket(std::size_t index) const {
  std::array<Piece, bucket_size> walls;
  std::size_t count = 0;
  std::size_t longest = 0;
  visit_bucket(index, [&](const ProgrammedPiece&, const Piece& wall, std::size_t) {
    if (std::abs(wall.sweep) > std::abs(walls[longest].sweep)) longest = count;
    walls[count++] = wall;
  });
  if (std::abs(walls[longest].sweep) <= long_sweep) return rings_.nodes[index];
  Ring ring = ring_of(walls[0], walls[longest].center);
  for (std::size_t number = 1; number < count; ++number)
    ring = around(ring, ring_of(walls[number], walls[longest].center));
  return ring;
}

}  // namespace trc::verify
