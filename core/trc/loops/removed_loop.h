#pragma once

#include <vector>

#include "core/trc/path_block.h"

namespace trc {

// The output in place of a loop that LoopRemoval takes out of the path, all at the point of the
// crossing: passive blocks in their order, and the travel of the dropped blocks out of the
// plane.
class DroppedBlocks {
 public:
  DroppedBlocks(const Point& place, PathBlocks& out) : place_(place), out_(out) {}

  // Adds the next contour block of the loop. Blocks without passive blocks count only as the first
  // and the last one.
  void add(PathBlockPtr block);
  // To be called after the last one.
  void finish();

 private:
  // Where the axes out of the plane stand.
  struct OtherAxes {
    double normal = 0;
    std::vector<double> tracking{};
  };

  static OtherAxes other_axes_at(const AxisTravel& normal, const TrackingTravel& tracking,
                                 double AxisTravel::*end);
  static OtherAxes other_axes_behind(const PathBlock& block);
  static OtherAxes other_axes_after(const PathBlock& block);
  // Makes one motion, where the axes are not yet where the block leaves them.
  void move_behind(const PathBlock& block);

  Point place_;
  PathBlocks& out_;
  OtherAxes other_axes_{};
  bool begun_ = false;
  PathBlockPtr waiting_{};  // its travel is still to be made; one motion serves many blocks
};

// Cuts a block next to a loop to its travelled part, mm along its tool path.
void shorten(PathBlock& block, double from, double to, const Point& start, const Point& end);

// GEN_CIR_BLOCK_IN_CORNER: a joint after a loop is an inside corner like any other. `arrives` is
// the direction of travel into it, `along` where on `after` it is.
[[nodiscard]] PathBlockPtr circle_behind_loop(const Point& place, const Vector& arrives,
                                              const PathBlock& after, double along);

}  // namespace trc
