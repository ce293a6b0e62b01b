#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/verify/piece.h"
#include "core/verify/selection_walls.h"

namespace trc::verify {

// Laps on top of each other have the same path again and again: where a piece of it was clear, it
// is so in later laps, which have to keep clear of no more walls. Remembers pieces that were clear,
// by where they begin and end.
class ClearBefore {
 public:
  // Remembers nothing where there are no laps. `pieces`: of the contour.
  ClearBefore(const SelectionWalls& walls, std::size_t pieces) {
    const SidedWalls& sides = walls.sides();
    if (sides.sides.size() == 1 && !sides.sides.front().rings.empty())
      numbers_.assign(std::min(most, std::bit_ceil(2 * pieces)), none);
  }
  // The number of a piece of path that may be the same as this one; nothing: none is known.
  [[nodiscard]] std::optional<std::size_t> find(const Piece& path) {
    if (numbers_.empty()) return std::nullopt;
    slot_ = slot_of(path);
    const std::size_t known = numbers_[slot_];
    return known == none ? std::nullopt : std::optional(known);
  }
  // The one that find() was asked for last is clear, and has this number.
  void keep(std::size_t number) {
    if (!numbers_.empty()) numbers_[slot_] = number;
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 16U;  // a power of 2
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] std::size_t slot_of(const Piece& path) const {
    std::uint64_t key = 0;
    for (const double value : {path.start.x(), path.start.y(), path.end.x(), path.end.y()})
      key = (std::rotl(key, 23) ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
    return key >> 32U & (numbers_.size() - 1);
  }

  std::vector<std::size_t> numbers_;
  std::size_t slot_ = 0;
};

}  // namespace trc::verify
