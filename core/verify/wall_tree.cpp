#include "core/verify/wall_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace trc::verify {
namespace {

// A box that holds a whole winding is near to everything within.
bool is_winding(const Box& box, const Ring& about_middle) {
  return box.half.sum() > 1.5 * about_middle.outer;
}

}  // namespace

WallTree::WallTree(const MeasuredPath& held, std::size_t begin, std::size_t end,
                   const SidedWalls& sides, Checkpoint& checkpoint)
    : held_(&held), begin_(begin), end_(end), sides_(sides) {
  find_special();
  std::size_t size = std::max<std::size_t>(1, (end - begin + bucket_size - 1) / bucket_size);
  std::size_t total = 0;
  for (;; size = (size + 1) / 2) {
    levels_.push_back({.first = total, .size = size});
    total += size;
    if (size == 1) break;
  }
  hide_copies(checkpoint);
  nodes_.reserve(total);
  leaves_.reserve(levels_.front().size);
  build_buckets(checkpoint);
  for (std::size_t level = 1; level < levels_.size(); ++level)
    build_level(levels_[level - 1], checkpoint);
  build_fours(checkpoint);
}

void WallTree::move_to(const MeasuredPath& held, std::size_t begin, Checkpoint& checkpoint) {
  held_ = &held;
  end_ = begin + (end_ - begin_);
  begin_ = begin;
  find_required(checkpoint);
}

void WallTree::find_required(Checkpoint& checkpoint) {
  for (std::size_t index = 0; index < levels_.front().size; ++index) {
    double required = -1;
    visit_bucket(index, [&](const ProgrammedPiece& block, const Piece&, std::uint32_t) {
      checkpoint.pass();
      required = std::max(required, held_->rule_of(block).required);
    });
    nodes_[index].required = required;
  }
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const Level& below = levels_[level - 1];
    const Level& own = levels_[level];
    for (std::size_t index = 0; index < own.size; ++index) {
      checkpoint.pass();
      const std::size_t first = below.first + 2 * index;
      double required = nodes_[first].required;
      if (2 * index + 1 < below.size) required = std::max(required, nodes_[first + 1].required);
      nodes_[own.first + index].required = required;
    }
  }
}

void WallTree::find_special() {
  for (std::size_t side = 0; side < sides_.sides.size(); ++side) {
    const std::size_t first = side > 0 ? sides_.changes[side - 1] : 0;
    const auto mark = [&](std::size_t number) {
      if (special_.empty()) special_.resize(end_ - begin_);
      special_[first + number] = true;
    };
    for (const Walls::Range& lead : sides_.sides[side].leads)
      for (std::size_t number = lead.first; number < lead.end; ++number) mark(number);
    for (const Walls::Part& part : sides_.sides[side].parts) mark(part.number);
  }
  has_special_ = !special_.empty();
}

Point WallTree::find_middle(Checkpoint& checkpoint) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low = Point::Constant(infinity);
  Point high = Point::Constant(-infinity);
  for (std::size_t number = begin_; number < end_; ++number) {
    checkpoint.pass();
    visit_wall(number, [&](const ProgrammedPiece&, const Piece& wall, std::uint32_t) {
      low = low.cwiseMin(wall.start);
      high = high.cwiseMax(wall.start);
    });
  }
  return low.x() <= high.x() ? Point(0.5 * (low + high)) : Point::Zero();
}

void WallTree::hide_copies(Checkpoint& checkpoint) {
  if (sides_.sides.size() != 1 || sides_.sides.front().rings.empty()) return;
  const auto& programmed = held_->programmed();
  const auto what_is_compared = [&](std::size_t number) {
    const auto& [piece, source, rule, its_number, is_contour, crosses, anywhere, role] =
        programmed[number];
    return std::array{piece.start.x(),  piece.start.y(),  piece.end.x(), piece.end.y(),
                      piece.center.x(), piece.center.y(), piece.sweep,   static_cast<double>(rule)};
  };
  // A hash of start and end finds equal pieces, in a table with room for twice as many.
  const auto key_of = [&](const Piece& piece) {
    std::uint64_t key = 0;
    // Adding 0 turns -0 into 0, as both are equal.
    for (const double value : {piece.start.x(), piece.start.y(), piece.end.x(), piece.end.y()})
      key = (std::rotl(key, 23) ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9E3779B97F4A7C15U;
    return key;
  };
  const std::size_t slots = std::bit_ceil(2 * (end_ - begin_));
  std::vector<std::uint32_t> latest(slots, hidden);  // the last of equal pieces, from `begin_` on
  first_.reserve(end_ - begin_);
  for (std::size_t number = begin_; number < end_; ++number) {
    checkpoint.pass();
    const ProgrammedPiece& block = programmed[number];
    first_.push_back(block.number);
    if (!block.is_contour || !is_whole(block.number)) continue;
    std::size_t slot = key_of(block.piece) >> 32U & (slots - 1);
    while (latest[slot] != hidden &&
           what_is_compared(begin_ + latest[slot]) != what_is_compared(number)) {
      checkpoint.pass();
      slot = (slot + 1) & (slots - 1);
    }
    if (latest[slot] != hidden) first_.back() = std::exchange(first_[latest[slot]], hidden);
    latest[slot] = static_cast<std::uint32_t>(number - begin_);
  }
}

// The box of a bucket lies along the way from the beginning of its walls to their end.
void WallTree::build_buckets(Checkpoint& checkpoint) {
  std::array<Piece, bucket_size> walls;
  std::array<std::size_t, bucket_size> places{};
  for (std::size_t index = 0; index < levels_.front().size; ++index) {
    Node& node = nodes_.emplace_back();
    KeptLeaf& leaf = leaves_.emplace_back();
    std::size_t count = 0;
    const std::size_t first = begin_ + index * bucket_size;
    for (std::size_t place = 0; place < bucket_size && first + place < end_; ++place)
      visit_wall(first + place, [&](const ProgrammedPiece& block, const Piece& wall, std::size_t) {
        checkpoint.pass();
        node.required = std::max(node.required, held_->rule_of(block).required);
        places[count] = place;
        walls[count++] = wall;
      });
    if (count == 0) continue;
    const Vector way = walls[count - 1].end - walls[0].start;
    const double length = way.norm();
    BoxAlong box(length > 0 ? Vector(way / length) : Vector::UnitX());
    leaf.origin = walls[0].start;
    for (std::size_t number = 0; number < count; ++number) {
      const Capsule capsule = capsule_of(walls[number]);
      add_to(box, capsule);
      leaf.walls.set(places[number], capsule, leaf.origin);
    }
    leaf.walls.finish();
    node.box = box.box();
  }
}

void WallTree::build_level(const Level& below, Checkpoint& checkpoint) {
  for (std::size_t index = below.first; index < below.first + below.size; index += 2) {
    checkpoint.pass();
    Node node = nodes_[index];
    if (index + 1 < below.first + below.size) {
      const Node& second = nodes_[index + 1];
      if (node.required < 0)
        node = second;
      else if (second.required >= 0)
        node = {.box = around(node.box, second.box),
                .required = std::max(node.required, second.required)};
    }
    nodes_.push_back(node);
  }
}

void WallTree::build_fours(Checkpoint& checkpoint) {
  for (std::size_t index = 0; index < levels_.front().size; ++index) {
    checkpoint.pass();
    origin_ = leaves_[index].origin;
    if (nodes_[index].required >= 0) break;
  }
  for (std::size_t level = 2; level < levels_.size(); level += 2) {
    const Level& below = levels_[level - 2];
    levels_[level].first_four = fours_.size();
    for (std::size_t index = 0; index < below.size; ++index) {
      checkpoint.pass();
      const std::size_t place = index % FourWalls::count;
      if (place == 0) fours_.emplace_back();
      const Node& node = nodes_[below.first + index];
      if (node.required >= 0) fours_.back().set(place, capsule_of(node.box), origin_);
      if (place + 1 == FourWalls::count || index + 1 == below.size) fours_.back().finish();
    }
  }
}

// The box around a whole group hardly ever separates two neighbouring leaves: they are found
// together.
void WallTree::add_near(const NodePlace& both, const Box& box, double reach,
                        std::vector<std::size_t>& found) const {
  if (least_gap(node_at(both).box, box, reach) >= reach) return;
  const std::size_t left = 2 * both.index;
  add_leaf(left, found);
  if (left + 1 < levels_.front().size) add_leaf(left + 1, found);
}

bool WallTree::find_near(const Box& box, double reach, std::vector<std::size_t>& found) const {
  found.clear();
  const FourWalls::Surroundings around(capsule_of(box), origin_, reach);
  // On every other level, up to three nodes wait for the one before them.
  std::array<NodePlace, 2 * most_levels> open;
  std::size_t count = 0;
  const std::size_t top = (levels_.size() - 1) / 2 * 2;
  for (std::size_t index = levels_[top].size; index-- > 0;)
    open[count++] = {.level = top, .index = index};
  for (std::size_t looked_at = 0; count > 0; looked_at += FourWalls::count) {
    if (looked_at > most_nodes) return false;
    const auto [level, index] = open[--count];
    if (level == 0) {
      add_leaf(index, found);
      continue;
    }
    const FourWalls::Bits near = fours_[levels_[level].first_four + index].near(around);
    if (level > 2) {
      for (std::size_t place = FourWalls::count; place-- > 0;)
        if ((near >> place & 1U) != 0)
          open[count++] = {.level = level - 2, .index = FourWalls::count * index + place};
      continue;
    }
    if ((near & 3U) != 0) add_near({.level = 1, .index = 2 * index}, box, reach, found);
    if ((near & 12U) != 0) add_near({.level = 1, .index = 2 * index + 1}, box, reach, found);
    if (found.size() > most_leaves) return false;
  }
  return true;
}

bool WallTree::find_near(const Box& box, const Ring& about_middle, double reach,
                         std::vector<std::size_t>& found) const {
  found.clear();
  const double inner = about_middle.inner - reach;
  const double outer = about_middle.outer + reach;
  const auto is_near = [&](std::size_t place) {
    const Box& own = nodes_[place].box;
    const Ring& ring = rings_.nodes[place];
    return ring.outer > inner && ring.inner < outer &&
           (is_winding(own, ring) || least_gap(own, box, reach) < reach);
  };
  // On each level, one node waits for its sibling.
  std::array<NodePlace, most_levels> open;
  std::size_t count = 0;
  open[count++] = whole();
  for (std::size_t looked_at = 0; count > 0; ++looked_at) {
    if (looked_at > most_nodes) return false;
    const NodePlace stretch = open[--count];
    const std::size_t place = place_of(stretch);
    if (nodes_[place].required < 0 || !is_near(place)) continue;
    if (stretch.level == 0) {
      add_leaf(stretch.index, found);
      continue;
    }
    const std::size_t left = 2 * stretch.index;
    const bool has_right = left + 1 < levels_[stretch.level - 1].size;
    if (stretch.level == 1) {
      add_leaf(left, found);
      if (has_right) add_leaf(left + 1, found);
      if (found.size() > most_leaves) return false;
      continue;
    }
    if (has_right) open[count++] = {.level = stretch.level - 1, .index = left + 1};
    open[count++] = {.level = stretch.level - 1, .index = left};
  }
  return true;
}

void WallTree::gather(const std::vector<std::size_t>& found, const Point& origin, bool with_rings,
                      std::vector<FourLeaves>& near) const {
  for (std::size_t number = 0; number < found.size(); ++number) {
    const std::size_t place = number % FourWalls::count;
    const std::size_t index = found[number];
    const Node& node = nodes_[index];
    const KeptLeaf& kept = leaves_[index];
    FourLeaves& four = place == 0 ? near.emplace_back() : near.back();
    Leaf& leaf = four.leaves[place];
    leaf = {.index = index, .walls = kept.walls};
    leaf.walls.move_origin(origin - kept.origin);
    four.around.set(place, capsule_of(node.box), origin);
    if (place + 1 == FourWalls::count || number + 1 == found.size()) four.around.finish();
    if (!with_rings) continue;
    four.rings.set(place, rings_.nodes[index]);
    four.are_windings = four.are_windings && is_winding(node.box, rings_.nodes[index]);
    leaf.rings = rings_.leaves[index];
  }
}

double WallTree::gap_of(const Probe& probe, const NodePlace& stretch, double reach) const {
  const Node& node = node_at(stretch);
  double gap = least_gap(node.box, probe.box, reach);
  if (gap >= reach || own_rings_.empty()) return gap;
  if (probe.ring.exists() && std::abs(probe.piece.sweep) > long_sweep)
    gap = std::max(gap, least_gap(probe.ring, ring_of(node.box, probe.ring.center)));
  const Ring& ring = own_rings_[place_of(stretch)];
  return std::max(
      gap, least_gap(ring, ring.center == rings_.middle ? probe.about_middle
                                                        : ring_of(probe.piece, ring.center)));
}

}  // namespace trc::verify
