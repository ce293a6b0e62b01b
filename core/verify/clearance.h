#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/trc/lead_settings.h"
#include "core/trc/result/compensated_block.h"
#include "core/verify/measured_path.h"

namespace trc::verify {

class KnownWalls;

// Counts the ways this has been measured in; a certificate names it.
inline constexpr std::uint32_t method_version = 2;

// How near one block of the path comes to a wall.
struct Clearance {
  double distance = 0;  // mm; negative on the wrong side of the contour
  double required = 0;  // mm, the tool radius
  Position place{};     // on the path, machine axes, mm
  Source path{};
  Source contour{};

  [[nodiscard]] double margin() const { return distance - required; }
};

// An approach or a retract through a wall.
struct CrossedWall {
  Source way{};
  Source wall{};
  Position place{};  // machine axes, mm
};

struct ClearanceReport {
  // The smallest margin, also where that is a touch: paths and walls at the two sides of a closing
  // may come nearer by as much as they are apart there (D-38). Empty: nothing to check.
  std::optional<Clearance> worst{};
  std::optional<Clearance> gouge{};  // the worst of the blocks that gouge
  std::uint64_t checked = 0;         // blocks of the path
  std::uint64_t walls = 0;           // blocks of the contour they were compared with
  std::uint64_t gouging = 0;         // of these, with a margin below -`allowed` that is no touch

  double wall_length = 0;     // mm, of all walls
  double touched_length = 0;  // mm, of these, that the path touches
  std::uint64_t steps = 0;    // pairs compared and stretches of contour looked at: the cost

  std::vector<CrossedWall> crossed{};  // in the order of the program

  // The share of the walls the path touches; walls have a length.
  [[nodiscard]] double coverage() const { return touched_length / wall_length; }
  // That of another part of the path.
  void add(const ClearanceReport& other);
};

// A stretch of a wall that the path does not touch: the programmed block, and what of it.
struct UncutWall {
  Source source{};
  Plane plane = Plane::xy;
  Segment path{};
};
// Is told them in the order of the program.
using UncutSink = std::function<void(const UncutWall&)>;

// What a path is measured against, and who is told.
struct ClearanceSettings {
  double allowed = 0;  // how much nearer than the tool radius the path may come, mm
  LeadSettings leads{};
  Tolerances tolerances{};
  UncutSink uncut{};  // none: nobody wants to know
  // What is kept of the walls from one path to another one; null: nothing.
  KnownWalls* known_walls = nullptr;
  // Is told every few blocks how many of the path have been measured, of how many in all.
  std::function<void(std::size_t measured, std::size_t all)> progress{};
};

// Measures every block of the compensated path between approach and retract against all walls of
// its selection, with the exact distance of lines and arcs, and looks whether approach and retract
// lead through one. Has distances and an index of its own,
// and decides nothing by the compensation: only source positions link path and contour. From the
// core it takes what follows from the program alone: blocks, and which of them are walls (D-38).
// Looks across a change of side, but for the blocks at the change itself (D-42).
//
// The radius of the path is required, and where it changes, the smaller one (D-159). The smallest
// margin is found up to `margin_resolution`: where the whole path runs at one distance, all of it
// is as near.
inline constexpr double margin_resolution = 1e-5;  // mm
[[nodiscard]] ClearanceReport measure_clearance(std::span<const Block> programmed,
                                                std::span<const CompensatedBlock> path,
                                                double allowed, const LeadSettings& leads = {});
[[nodiscard]] ClearanceReport measure_clearance(std::span<const Block> programmed,
                                                std::span<const CompensatedBlock> path,
                                                const ClearanceSettings& settings);

// Measures held pieces before the number `end`, and the path that stems from them.
[[nodiscard]] ClearanceReport measure_clearance(const MeasuredPath& held, std::size_t end,
                                                const ClearanceSettings& settings,
                                                Checkpoint& checkpoint);

}  // namespace trc::verify
