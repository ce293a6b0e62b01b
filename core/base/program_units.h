#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "core/base/length_unit.h"

namespace trc {

// The unit of the lengths in a program, block by block, as far as it has been read; mm until the
// program gives one. Messages use it (D-46).
class ProgramUnits {
 public:
  // Holds from this block (Source::index) on; blocks ascend.
  void count_in(LengthUnit unit, std::uint64_t from_block) {
    if (unit_in(from_block) != unit) changes_.push_back({.from_block = from_block, .unit = unit});
  }

  [[nodiscard]] LengthUnit unit_in(std::uint64_t block) const {
    const auto behind = std::upper_bound(
        changes_.begin(), changes_.end(), block,
        [](std::uint64_t place, const Change& change) { return place < change.from_block; });
    return behind != changes_.begin() ? std::prev(behind)->unit : LengthUnit::mm;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(changes_);
  }

 private:
  struct Change {
    std::uint64_t from_block = 0;
    LengthUnit unit = LengthUnit::mm;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(from_block, unit);
    }
  };

  std::vector<Change> changes_;
};

}  // namespace trc
