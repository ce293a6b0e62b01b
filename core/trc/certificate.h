#pragma once

#include <cstddef>
#include <deque>

#include "core/base/numbered_queue.h"
#include "core/base/tolerances.h"
#include "core/trc/held_path.h"
#include "core/trc/path_block.h"

namespace trc {

// Which contour blocks are too near on the contour, and too well-behaved, to be
// in the way of one another's equidistants; LoopRemoval need not compare them.
//
// A chain of contour blocks is certified when both corners leave something of each
// block, one radius and one side hold throughout, and the directions of travel in it
// differ by less than half a turn. Then the equidistant of the chain, its transitions
// included, stays a tool radius away from all of the chain. The proof is in
// core/README.md.
class Certificate {
 public:
  explicit Certificate(const Tolerances& tolerances) : tolerances_(tolerances) {}

  // Appends a contour block; `apart`: its equidistant does not meet that of the
  // block before.
  void append(const PathBlock& block, bool apart);
  [[nodiscard]] std::size_t size() const { return first_of_chain_.end(); }
  // Nobody will ask about blocks before this one any more.
  void drop_before(std::size_t block);

  // The first block of the longest certified chain that ends with `block`.
  [[nodiscard]] std::size_t chain_before(std::size_t block) const { return first_of_chain_[block]; }
  // The last block of the longest certified chain that begins with `block`.
  [[nodiscard]] std::size_t chain_behind(std::size_t block) const {
    return block < chain_ ? last_of_chain_[block] : size() - 1;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(first_of_chain_, last_of_chain_, chain_, direction_, tangent_, shift_, least_,
            greatest_);
  }

 private:
  // The least (or greatest) direction of the blocks in the running chain.
  struct Extreme {
    std::size_t block = 0;
    double direction = 0;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, direction);
    }
  };

  // No chain that begins before `block` goes on behind the last one but `last`.
  void begin_chain(std::size_t block, std::size_t last);

  Tolerances tolerances_;
  NumberedQueue<HeldPath::Number> first_of_chain_;
  NumberedQueue<HeldPath::Number> last_of_chain_;  // of the blocks before chain_

  // The running chain. Directions are counted on over full turns.
  std::size_t chain_ = 0;
  double direction_ = 0;  // rad, at the end of the last block
  Vector tangent_ = Vector::UnitX();
  double shift_ = 0;
  std::deque<Extreme> least_;
  std::deque<Extreme> greatest_;
};

}  // namespace trc
