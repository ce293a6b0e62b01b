#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/walls/walls.h"

namespace trc::verify {

// How near one block of the path comes to the contour.
struct Clearance {
  double distance = 0;  // mm; negative on the wrong side of the contour
  double required = 0;  // mm, the tool radius
  Position place{};     // on the path, machine axes, mm
  Source path{};
  Source contour{};
  bool accepted = false;  // IGNORE_CONT_DAMAGE holds there

  [[nodiscard]] double margin() const { return distance - required; }
};

struct ClearanceReport {
  std::optional<Clearance> worst{};  // the smallest margin; empty: nothing to check
  std::uint64_t checked = 0;         // blocks of the path
  std::uint64_t gouging = 0;         // of these, with a margin below -`allowed`
  std::uint64_t accepted = 0;        // of these, under IGNORE_CONT_DAMAGE
  double wall_length = 0;            // mm, of all walls
  double touched_length = 0;         // mm, of these, that the path touches

  // The share of the walls the path touches; walls have a length.
  [[nodiscard]] double coverage() const { return touched_length / wall_length; }
};

// Measures every block of the compensated path between approach and retract
// against every wall of its selection (D-38), pair by pair with the exact
// distance of lines and arcs. Shares no code with the compensation and decides
// nothing by it: only source positions link path and contour. What is a wall is
// data: it follows from the program alone. Looks across a change of side, but
// for the blocks at the change itself (D-42).
//
// Where the tool radius changes, the smaller one is required.
[[nodiscard]] ClearanceReport measure_clearance(std::span<const Block> programmed,
                                                std::span<const CompensatedBlock> path,
                                                double allowed, const LeadSettings& leads = {});

}  // namespace trc::verify
