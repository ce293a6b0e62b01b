#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/base/numbered_queue.h"
#include "core/base/tolerances.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/path_block.h"

namespace trc {

// Tells which contour blocks, close to each other along the contour, cannot be in the way of one
// another's equidistants; LoopRemoval need not compare them.
//
// A chain of contour blocks is certified when both corners leave something of each
// block, one radius and one side hold throughout, and the directions of travel in it
// differ by less than half a turn. Then the equidistant of the chain, its transitions
// included, stays a tool radius away from all of the chain. The proof is in
// core/doc/loop_removal.md.
class Certificate {
 public:
  // Half a turn, rad, less the effect of rounding: a wider arc is in no chain.
  static constexpr double widest_arc = std::numbers::pi - 4e-6;

  explicit Certificate(const Tolerances& tolerances) : tolerances_(tolerances) {}

  // The data of a contour block that the certificate needs.
  struct Block {
    Vector tangent_at_start = Vector::UnitX();
    Vector tangent_at_end = Vector::UnitX();
    double sweep = 0;  // rad, of the programmed arc
    double left = 0;   // mm of the programmed path that inside corners leave; 0: unreachable
    double shift_at_start = 0;
    double shift_at_end = 0;
  };
  [[nodiscard]] static Block block_of(const PathBlock& block);

  // Whether the equidistant of a contour block meets that of the block before it.
  enum class Begin : std::uint8_t { joined, behind_gap };

  // Appends a contour block.
  void append(const Block& block, Begin begin);
  [[nodiscard]] std::size_t size() const { return first_of_chain_.end(); }
  // Blocks before this one will not be asked about any more.
  void drop_before(std::size_t block);
  // Forgets all blocks.
  void clear();

  // The first block of the longest certified chain that ends with `block`.
  [[nodiscard]] std::size_t chain_before(std::size_t block) const { return first_of_chain_[block]; }
  // The last block of the longest certified chain that begins with `block`.
  [[nodiscard]] std::size_t chain_behind(std::size_t block) const {
    return block < chain_ ? last_of_chain_[block] : size() - 1;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(first_of_chain_, last_of_chain_, chain_, direction_, turns_, shift_, directions_,
            middle_, behind_middle_);
    if constexpr (Archive::is_loading::value) up_to_middle_ = directions_from(chain_);
  }

 private:
  // Directions of travel, counted on over full turns, as on_square() measures them.
  struct Directions {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -std::numeric_limits<double>::infinity();

    void include(const Directions& others) {
      least = std::min(least, others.least);
      greatest = std::max(greatest, others.greatest);
    }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(least, greatest);
    }
  };

  // Counts the next direction on from that of the last block, and keeps it.
  double counted_on(double on_square);
  // No chain that begins before `block` goes on beyond `last`.
  void begin_chain(std::size_t block, std::size_t last);
  void move_middle_to_end();
  // The directions of `block` up to middle_; none for a block from middle_ on.
  [[nodiscard]] Directions directions_from(std::size_t block) const {
    return block < middle_ ? directions_[block] : Directions{};
  }
  [[nodiscard]] bool is_too_wide() const;

  Tolerances tolerances_;
  NumberedQueue<HeldPath::Number> first_of_chain_;
  NumberedQueue<HeldPath::Number> last_of_chain_;  // of the blocks before chain_

  // The running chain.
  std::size_t chain_ = 0;
  double direction_ = 0;  // at the end of the last block
  double turns_ = 0;      // full ones, of that
  double shift_ = 0;
  // Before middle_ the directions of each block together with all after it up to middle_; from
  // middle_ on those of each block alone, and of all of these together. So the directions of the
  // whole chain are known in one step wherever it begins, and each block is looked at twice.
  NumberedQueue<Directions> directions_;
  std::size_t middle_ = 0;
  Directions up_to_middle_{};  // of those before it
  Directions behind_middle_{};
};

}  // namespace trc
