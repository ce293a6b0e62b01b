#pragma once

#include "core/trc/loops/held_path.h"
#include "core/trc/path_block.h"

namespace trc {

// The selection that LoopRemoval holds, with facts noted as its blocks came.
struct HeldSelection {
  PathBlocks entering{};  // the approach, which leaves with the first block of the path
  HeldPath path{};
  double largest_radius = 0;  // mm
  double farthest_reach = 0;  // how far from a block its path may lie, mm
  bool gap = false;           // the next contour block does not meet the last one
  bool has_linear = false;    // it asks for linear transitions
  bool has_short = false;     // a contour block may be one of a bow tie

  [[nodiscard]] bool is_empty() const { return entering.empty() && path.empty(); }
  // Forgets all, but keeps the memory: a new selection begins.
  void clear() {
    entering.clear();
    path.clear();
    largest_radius = farthest_reach = 0;
    gap = has_linear = has_short = false;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(entering, path, largest_radius, farthest_reach, gap, has_linear, has_short);
  }
};

}  // namespace trc
