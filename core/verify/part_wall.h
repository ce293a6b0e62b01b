#pragma once

#include "core/nc/state/trc_mode.h"
#include "core/verify/piece.h"

namespace trc::verify {

// In wear mode the program is the centre path of a tool (D-43), and the walls are what that tool
// leaves: the part.
struct PartWall {
  Piece piece{};  // a point where the tool turns about a corner of the part: none of its own
  bool exists = true;
};

// What the block of a centre path leaves, where a tool of `nominal_radius` runs with the part on
// the other side than `tool_side`.
[[nodiscard]] PartWall part_wall(const Piece& centre_path, Side tool_side, double nominal_radius);

// Two such walls one after the other cross where the centre path turns towards the part without an
// arc: both end there. Of which nothing is left, that is none. Lines only.
void end_at_corner(PartWall& before, PartWall& after, Side tool_side);

}  // namespace trc::verify
