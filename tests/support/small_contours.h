#pragma once

#include <string>

#include "core/nc/state/trc_mode.h"
#include "tests/support/contours.h"
#include "tests/support/random.h"

namespace trc::support {

// Small contours in which everything that is hard about loops happens at once:
// blocks from 1e-5 to 1e4 mm, radii from 1e-3 to 1e3 mm, tangential joints,
// collinear doubles, exact reversals, points programmed twice, full circles, slots
// as wide as the tool, equidistants that touch or run on top of each other.
enum class Hardship {
  sizes,    // lines and arcs of any size, open
  bends,    // of about the size of the tool, open
  rounds,   // closed, from the middle of a line on
  grid,     // whole-number corners, open or closed
  slots,    // slots of the width of the tool, and 1e-6 mm more or less
  repeats,  // there and back again, the same block twice
};

inline constexpr Hardship all_hardships[] = {Hardship::sizes, Hardship::bends, Hardship::rounds,
                                             Hardship::grid,  Hardship::slots, Hardship::repeats};

[[nodiscard]] std::string name_of(Hardship hardship);

struct SmallContour {
  Contour contour{};
  // Side and radius, G138, loop removal; G26.
  TrcMode mode{};
};

[[nodiscard]] SmallContour small_contour(Random& random, Hardship hardship);

}  // namespace trc::support
