#pragma once

#include <cstddef>

#include "core/base/numbered_queue.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/trc/loops/held_path.h"

namespace trc {

// A point of the path of a selection: how far along which block.
struct PathPlace {
  std::size_t block = 0;  // counted from the start of the selection
  double along = 0;       // mm from the start of its tool path

  bool operator<(const PathPlace& other) const {
    return block != other.block ? block < other.block : along < other.along;
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(block, along);
  }
};

// The travelled part of a block; its ends are shared with its neighbours.
struct PathPiece {
  std::size_t block = 0;
  double from = 0;
  double to = 0;
  Point start = Point::Zero();
  Point end = Point::Zero();
  bool behind_loop = false;          // a loop was dropped before it
  Vector arrives = Vector::UnitX();  // the direction of travel into the loop

  // Whether it is all of the path of its block, which has this length.
  [[nodiscard]] bool is_all_of(const Segment& path, double length) const {
    return from == 0 && to == length && start == start_of(path) && end == end_of(path);
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(block, from, to, start, end, behind_loop, arrives);
  }
};

// The pieces of the path that LoopRemoval has walked and that have not left yet. They are counted
// from the start of the selection.
class WalkedPath {
 public:
  // A piece as it is kept: most are whole blocks.
  struct Kept {
    static constexpr HeldPath::Number whole = HeldPath::most_blocks;
    HeldPath::Number block = 0;
    HeldPath::Number cut = whole;  // of the others: the number in cuts_

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, cut);
    }
  };

  // `finds_near`: for_each_near() will be called.
  WalkedPath(const HeldPath& path, bool finds_near) : path_(path), finds_near_(finds_near) {}

  [[nodiscard]] std::size_t begin() const { return pieces_.begin(); }
  [[nodiscard]] std::size_t end() const { return pieces_.end(); }
  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const Kept& kept(std::size_t number) const { return pieces_[number]; }
  [[nodiscard]] const PathPiece& cut(HeldPath::Number cut) const { return cuts_[cut]; }
  [[nodiscard]] PathPiece& cut(HeldPath::Number cut) { return cuts_[cut]; }
  [[nodiscard]] PathPiece operator[](std::size_t number) const;
  // The number of pieces, up to `most`, that are consecutive whole blocks from `block` on, counted
  // from the first piece.
  [[nodiscard]] std::size_t whole_in_a_row(std::size_t block, std::size_t most) const;

  void add_whole(std::size_t block) {
    pieces_.push_back({.block = static_cast<HeldPath::Number>(block)});
    if (finds_near_) note_box(block);
  }
  // Adds the whole blocks from `block` on and before `end`.
  void add_whole(std::size_t block, std::size_t end) {
    if (finds_near_)
      for (std::size_t number = block; number < end; ++number) note_box(number);
    for (; block < end; ++block) pieces_.push_back({.block = static_cast<HeldPath::Number>(block)});
  }
  void add(const PathPiece& piece);
  // Forgets the pieces from `number` on: they are walked again.
  void truncate(std::size_t number);
  // Forgets the pieces before `number`, which have left.
  void drop_before(std::size_t number) { pieces_.drop_before(number); }
  void drop_cuts_before(HeldPath::Number cut) { cuts_.drop_before(cut); }
  // Drops the boxes of those pieces, which for_each_near() uses.
  void drop_boxes_before(std::size_t number) { boxes_.drop_before(number); }
  void drop_boxes() { boxes_.clear(); }
  // Forgets all: a new selection begins.
  void clear();

  // Calls visit(number) for every piece whose block is not farther than `reach` mm from `area`,
  // those in `skipped` left out.
  template <class Visit>
  void for_each_near(const Box& area, double reach, const BoxTree::Range& skipped,
                     Visit visit) const {
    boxes_.for_each_near(area, reach, skipped, visit);
  }

  // To be called after the path.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(pieces_, cuts_);
    if constexpr (Archive::is_loading::value) rebuild_boxes();
  }

 private:
  void note_box(std::size_t block);
  void rebuild_boxes();

  const HeldPath& path_;
  bool finds_near_;
  NumberedQueue<Kept> pieces_;
  NumberedQueue<PathPiece> cuts_;  // those that are not whole blocks
  BoxTree boxes_;
};

}  // namespace trc
