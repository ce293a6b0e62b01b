#pragma once

#include <cmath>
#include <optional>
#include <variant>

#include "core/base/diagnostic.h"
#include "core/base/tolerances.h"
#include "core/trc/corner/corner.h"
#include "core/trc/path_block.h"

namespace trc {

// Why two blocks cannot be joined.
struct JointRefusal {
  Code code{};
  bool of_after = false;  // the block after the corner is at fault, else the one before
  Point place = Point::Zero();
};

struct JoinedBlocks {
  Joint joint{};
  // The arc G05 makes of the approach (retract) block.
  std::optional<Segment> tangential_path{};
  // The equidistants do not meet on their blocks: what is inserted leads from one to
  // the other through the contour, for LoopRemoval to leave out.
  bool gap = false;
};

using JointResult = std::variant<JoinedBlocks, JointRefusal>;

// The corner between two blocks that follow each other, with the compensation in
// force at the end of `before`.
[[nodiscard]] Corner corner_between(const PathBlock& before, const PathBlock& after,
                                    const Tolerances& tolerances);

// The rule for a corner by what its two blocks are: the table of transitions
// between contour blocks, the rules of the selection modes at both ends.
[[nodiscard]] JointResult joint_between(const PathBlock& before, const PathBlock& after,
                                        const Corner& corner, const Tolerances& tolerances);

// The joint round an outside corner: the table of rule 4.2 with STRETCH_FACTOR; up to 181 degrees
// EXT_ANGLE_BLOCK_INTERSECTION.
[[nodiscard]] Joint transition_joint(const Corner& corner, const TrcMode& mode,
                                     const Tolerances& tolerances);

// The extent that corners cut from: mm of a line, rad of an arc.
[[nodiscard]] inline double extent_of(const Segment& programmed) {
  const auto* arc = std::get_if<Arc>(&programmed);
  return arc != nullptr ? std::abs(arc->sweep) : length_of(programmed);
}

// The part of the equidistant of a block that two corners leave: mm of a line, rad of an arc, as
// the cuts. Negative: the block would run backwards.
[[nodiscard]] double left_of_block(const PathBlock& block, double cut_at_start, double cut_at_end);

}  // namespace trc
