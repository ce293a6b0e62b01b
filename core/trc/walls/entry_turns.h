#pragma once

#include <cstddef>
#include <optional>

#include "core/trc/walls/closing.h"

namespace trc {

// Blocks of a contour between those that screw the tool down to it and up from it.
struct BetweenTurns {
  std::size_t first = 0;
  std::size_t end = 0;
};

// The first and the last blocks that go round one circle, as arcs or as chords, with the tool
// inside of it, for a whole turn or more: what is left without the whole turns. Nothing: there are
// none.
[[nodiscard]] std::optional<BetweenTurns> between_turns(const ContourView& contour,
                                                        double tolerance);

// Whether such turns lead to the contour that closes there (D-106): all of their path is in the
// space that the tool has beside it, and where that is around the contour they come near it.
[[nodiscard]] bool are_leads(const ContourView& contour, const BetweenTurns& between,
                             const Closing& closing, double tolerance, double tool_radius);

}  // namespace trc
