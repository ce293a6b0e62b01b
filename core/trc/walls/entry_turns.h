#pragma once

#include <cstddef>
#include <optional>

#include "core/trc/walls/closing.h"

namespace trc {

// Blocks of a contour between the turns that move the tool down to it and up from it.
struct BetweenTurns {
  std::size_t first = 0;
  std::size_t end = 0;
};

// The blocks left without whole turns at the start and at the end: turns are blocks that go
// round one circle, as arcs or as chords, with the tool inside it. Nothing: there are no whole
// turns.
[[nodiscard]] std::optional<BetweenTurns> between_turns(const ContourView& contour,
                                                        double tolerance);

// Whether such turns lead to the contour that closes there (D-106): their whole path lies in the
// space of the tool beside the contour and, where that space is outside it, comes near it.
[[nodiscard]] bool are_leads(const ContourView& contour, const BetweenTurns& between,
                             const Closing& closing, double tolerance, double tool_radius);

}  // namespace trc
