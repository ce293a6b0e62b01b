#include "core/verify/wall_tree.h"

#include <algorithm>
#include <cmath>

namespace trc::verify {
namespace {

// Shorter arcs lie in boxes thin enough.
constexpr double long_sweep = 0.5;  // rad

// Of what lies in the box and in the ring, where there is one, about another centre.
Ring seen_from(const Point& center, const Box& box, const Ring& ring) {
  Ring seen = ring_of(box, center);
  if (!ring.exists()) return seen;
  const double apart = (ring.center - center).norm();
  seen.inner = std::max({seen.inner, ring.inner - apart, apart - ring.outer});
  seen.outer = std::min(seen.outer, ring.outer + apart);
  return seen;
}

}  // namespace

WallTree::WallTree(const HeldPath& held, std::size_t begin, std::size_t end, Checkpoint& checkpoint)
    : held_(held), begin_(begin), end_(end) {
  std::size_t size = std::max<std::size_t>(1, (end - begin + bucket_size - 1) / bucket_size);
  std::size_t total = 0;
  for (;; size = (size + 1) / 2) {
    levels_.push_back({.first = total, .size = size});
    total += size;
    if (size == 1) break;
  }
  for (std::size_t number = begin; number < end && !has_rings_; ++number) {
    checkpoint.pass();
    const ProgrammedPiece& piece = held.programmed()[number];
    has_rings_ = piece.is_wall && std::abs(piece.piece.sweep) > long_sweep;
  }
  nodes_.reserve(total);
  if (has_rings_) rings_.reserve(total);
  build_buckets(checkpoint);
  for (std::size_t level = 1; level < levels_.size(); ++level)
    build_level(levels_[level - 1], checkpoint);
}

void WallTree::build_buckets(Checkpoint& checkpoint) {
  for (std::size_t index = 0; index < levels_.front().size; ++index) {
    Node node;
    const Piece* longest = nullptr;
    visit_bucket(index, [&](const ProgrammedPiece& wall) {
      checkpoint.pass();
      ++walls_;
      const Box box = box_of(wall.piece);
      node.box = node.required < 0 ? box : around(node.box, box);
      node.required = std::max(node.required, held_.rule_of(wall).required);
      if (longest == nullptr || std::abs(wall.piece.sweep) > std::abs(longest->sweep))
        longest = &wall.piece;
    });
    nodes_.push_back(node);
    if (!has_rings_) continue;
    Ring ring;
    if (longest != nullptr && longest->is_arc())
      visit_bucket(index, [&](const ProgrammedPiece& wall) {
        const Ring own = ring_of(wall.piece, longest->center);
        ring = ring.exists() ? around(ring, own) : own;
      });
    rings_.push_back(ring);
  }
}

void WallTree::build_level(const Level& below, Checkpoint& checkpoint) {
  for (std::size_t index = below.first; index < below.first + below.size; index += 2) {
    checkpoint.pass();
    const bool pair = index + 1 < below.first + below.size && nodes_[index + 1].required >= 0;
    const bool second_only = pair && nodes_[index].required < 0;
    Node node = nodes_[second_only ? index + 1 : index];
    if (has_rings_)
      rings_.push_back(pair && !second_only ? ring_around(index, index + 1)
                                            : rings_[second_only ? index + 1 : index]);
    if (pair && !second_only) {
      node.box = around(node.box, nodes_[index + 1].box);
      node.required = std::max(node.required, nodes_[index + 1].required);
    }
    nodes_.push_back(node);
  }
}

// About the centre of one of the two, whatever is narrowest.
Ring WallTree::ring_around(std::size_t a, std::size_t b) const {
  Ring best;
  for (const Ring& kept : {rings_[a], rings_[b]}) {
    if (!kept.exists()) continue;
    const Ring ring = around(seen_from(kept.center, nodes_[a].box, rings_[a]),
                             seen_from(kept.center, nodes_[b].box, rings_[b]));
    if (!best.exists() || ring.outer - ring.inner < best.outer - best.inner) best = ring;
  }
  return best;
}

double WallTree::gap_of(const Probe& probe, std::size_t level, std::size_t index) const {
  const std::size_t place = levels_[level].first + index;
  const Node& node = nodes_[place];
  double gap = least_gap(probe.box, node.box);
  if (probe.ring.exists() && std::abs(probe.piece.sweep) > long_sweep)
    gap = std::max(gap, least_gap(probe.ring, ring_of(node.box, probe.ring.center)));
  if (has_rings_ && rings_[place].exists())
    gap = std::max(gap, least_gap(rings_[place], ring_of(probe.piece, rings_[place].center)));
  return gap;
}

}  // namespace trc::verify
