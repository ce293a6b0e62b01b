#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/geometry/box_tree.h"
#include "core/trc/pass.h"
#include "core/trc/path_block.h"
#include "core/trc/setup.h"
#include "core/trc/walls/closing_watch.h"
#include "core/trc/walls/sided_walls.h"

namespace trc {

// Looks for bottlenecks: path blocks that come closer to any wall of their selection than the tool
// radius, however far apart on the contour, also across a change of side, but for the blocks at the
// change itself (D-38, D-42). Under G141 each is a warning (rule 5.1: loops that still violate
// stay); with P-CHAN-00219 the first one stops, also under G140 (D-34).
//
// Holds such a selection as a whole, or looks a window of contour blocks ahead and back (D-10); all
// else passes through at once.
class Bottlenecks {
 public:
  Bottlenecks(const CompensatorSetup& setup, Diagnostics& diagnostics, Checkpoint& checkpoint)
      : implicit_(setup.implicit_contour_masking),
        window_(setup.limits.look_ahead_blocks),
        selection_blocks_(setup.limits.selection_blocks),
        lead_settings_(setup.leads),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        closing_(lead_settings_, window_) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out) { return end_selection(out); }
  [[nodiscard]] bool is_empty() const { return held_.empty() && contour_.empty(); }
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return is_empty() &&
           (block.removes_loops() || (!implicit_ && block.mode().masking == Masking::off));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, numbers_, contour_, contour_base_, changes_, walls_, closing_, has_roles_,
            violating_);
    boxes_ = BoxTree(contour_base_);
    for (const MotionBlock& block : contour_) boxes_.append(bounding_box(block.path));
  }

 private:
  // A warning may come after its block: the block need not wait for its window.
  [[nodiscard]] bool passes_at_once() const { return window_ > 0 && !implicit_; }
  void hold(PathBlockPtr block);
  // The contour from a block on.
  [[nodiscard]] ContourView contour_from(std::size_t first) const;
  // Finds the walls, once the contour has ended and if its start is still known, or that of its
  // last lap.
  void find_walls();
  // The part of a contour block that is a wall for the path of another one, and how near that path
  // may come to it where `limit` holds for walls; empty if it is no wall.
  struct Wall {
    Segment path{};
    double limit = 0;
  };
  [[nodiscard]] std::optional<Wall> wall_for(std::size_t path, std::size_t other,
                                             double limit) const;
  bool end_selection(PathBlocks& out);
  // Releases all blocks around which the contour is known.
  bool examine(Input input, PathBlocks& out);
  enum class Verdict : std::uint8_t { goes_on, stops, undecided };
  // Undecided: a lead may be in the way, and the closing is not known yet.
  Verdict check(const PathBlock& block, std::size_t number, Input input);
  void forget();
  bool report(const PathBlock& path, const MotionBlock& contour, double distance,
              const Point& place);

  bool implicit_;
  std::size_t window_;
  std::size_t selection_blocks_;
  LeadSettings lead_settings_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;
  PathBlocks held_;
  std::vector<std::size_t> numbers_;  // of the contour block, or of the one before it

  // The contour, counted from the start of the selection, as far as a window reaches.
  std::vector<MotionBlock> contour_;
  std::size_t contour_base_ = 0;
  std::vector<std::size_t> changes_;  // of side: the first contour block after each
  std::optional<SidedWalls> walls_;   // nothing: all of the contour is one
  ClosingWatch closing_;              // for a window only
  BoxTree boxes_;
  bool has_roles_ = false;  // of the contour blocks
  bool violating_ = false;  // the block before was too near: one report per stretch
};

}  // namespace trc
