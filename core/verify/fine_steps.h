#pragma once

#include <algorithm>
#include <cstddef>

#include "core/geometry/flat_arc.h"
#include "core/verify/measured_path.h"

namespace trc::verify {

// Lines as short as rounding leaves them, and what that allows beside them (D-44). `required`: the
// least distance of the path, mm.
class FineSteps {
 public:
  FineSteps(const MeasuredPath& held, double input_resolution)
      : held_(held), input_resolution_(input_resolution) {}

  // mm. A line no longer than that is as short as rounding leaves it where nothing was meant.
  [[nodiscard]] double shortest(double required) const { return 1.5 * rounding(required); }
  // Such a line has no side.
  [[nodiscard]] bool is_hardly_there(const Piece& own, double required) const {
    return !own.is_arc() && (own.end - own.start).norm() <= shortest(required);
  }
  // The wall is one, or the programmed piece of this number, or the one before or after that,
  // which is turned with it.
  [[nodiscard]] bool are_beside(const ProgrammedPiece& wall, std::size_t number,
                                double required) const {
    const auto& blocks = held_.programmed();
    return is_one(wall, required) || is_one(blocks[number], required) ||
           (number > blocks.begin() && is_one(blocks[number - 1], required)) ||
           (number + 1 < blocks.end() && is_one(blocks[number + 1], required));
  }

 private:
  [[nodiscard]] double rounding(double required) const {
    return std::min(input_resolution_, 0.01 * required);
  }
  // Lines that rounding has bent so that a corner takes more than there is of them may be joined
  // within that distance.
  [[nodiscard]] bool is_one(const ProgrammedPiece& block, double required) const {
    if (!held_.rule_of(block).joins_fine_steps) return false;
    const double longest = 5 * required * rounding(required);  // mm²
    const double chord = (block.piece.end - block.piece.start).norm();
    return chord * chord <= longest && is_flat_arc(chord, block.piece.sweep, input_resolution_);
  }

  const MeasuredPath& held_;
  double input_resolution_;  // mm
};

}  // namespace trc::verify
