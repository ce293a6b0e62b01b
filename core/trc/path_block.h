#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/recycled.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"

namespace trc {

// The role of a block in TRC.
enum class Role : std::uint8_t {
  passive,        // no motion in the plane; travels alone only while TRC is off
  uncompensated,  // TRC is off, or the selection has no contour (D-28)
  approach,       // selection block: from where the tool is to the equidistant
  contour,
  retract,      // deselection block
  side_change,  // retract of the old side and approach of the new one (rule 9)
  inserted,     // by TRC: transition blocks, parts of approach and retract
};

// The compensation in force at one end of a block.
struct Compensation {
  bool active = false;
  double shift = 0;  // mm to the left of the programmed contour; negative: right

  bool operator==(const Compensation&) const = default;
};

// The shift that the tool would need, even under SUPPRESS_TRC: the passes that work on the
// programmed contour use this one (D-17).
[[nodiscard]] inline double shift_of_tool(const TrcMode& mode) {
  return mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
}

// A block on its way, programmed and compensated side by side: every pass can
// check one against the other. It is large, so the passes hand on its owner.
struct PathBlock {
  MotionBlock programmed{};
  Role role = Role::uncompensated;
  Origin origin = Origin::uncompensated;
  // The contour begins or ends here with a block across it (G237).
  bool perpendicular_entry = false;
  bool perpendicular_exit = false;
  Compensation at_start{};
  Compensation at_end{};
  bool before_short = false;  // RoundedInput waits for the line after it; set by RelevantBlocks

  // Of the programmed segment; set by Offset.
  Vector tangent_at_start = Vector::Zero();
  Vector tangent_at_end = Vector::Zero();
  // The perpendicular points P and Q (core/doc/rules.md); set by Offset where active.
  Point offset_start = Point::Zero();
  Point offset_end = Point::Zero();

  // The result; set by Transitions. The cuts are the parts that the corners take off the
  // equidistant: mm of a line, rad of an arc; negative where they extend it.
  Segment tool_path{};
  Point tool_start = Point::Zero();
  bool path_given = false;  // a G05 arc: tool_path stands before the ends are known
  bool behind_tip = false;  // the tool goes round the corner before it whatever its angle (D-44)
  double cut_at_start = 0;
  double cut_at_end = 0;
  bool splittable = false;  // an approach or retract line that SPLIT may divide

  // Set by Transitions where the corners take more than the whole block: half the width of the slot
  // between its neighbours, or else the largest tool for which they leave a path at the block, both
  // as radii beside the programmed contour; 0: not known, or of no use.
  double half_slot = 0;
  double largest_radius = 0;

  // Set by ContourMasking (G141), and by Offset: programmed, but not travelled; and the joint of
  // the first block after masked ones with the last one before them.
  bool masked = false;
  struct Rejoin {
    Point point = Point::Zero();  // where the one before ends
    // Where the block starts. If that is not `point`, a line leads there, or an arc that goes on
    // from the arc before.
    Point start = Point::Zero();
    double cut_before = 0;
    double cut_after = 0;
    bool leads_on_arc = false;
  };
  std::optional<Rejoin> rejoin{};

  // Set by Offset and Transitions under REMOVE_MASKED_BLOCKS: no part of it can be travelled, since
  // its equidistant does not exist or does not meet the next one. LoopRemoval leaves it out.
  bool unreachable = false;

  // Passive blocks programmed after this one, in order. Those after G40 wait for
  // the block across the contour that G237 inserts.
  std::vector<PassiveBlock> passive{};
  std::vector<PassiveBlock> passive_after_exit{};

  [[nodiscard]] const TrcMode& mode() const { return *programmed.mode; }
  [[nodiscard]] bool removes_loops() const {
    return role != Role::passive && mode().removes_loops();
  }

  static void* operator new(std::size_t size);
  static void operator delete(void* place) noexcept;
};

inline void* PathBlock::operator new(std::size_t /*size*/) {
  return Recycled<sizeof(PathBlock)>::take();
}
inline void PathBlock::operator delete(void* place) noexcept {
  Recycled<sizeof(PathBlock)>::give_back(place);
}

using PathBlockPtr = std::unique_ptr<PathBlock>;
using PathBlocks = std::vector<PathBlockPtr>;

}  // namespace trc
