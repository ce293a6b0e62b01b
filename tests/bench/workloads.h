#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::bench {

// Closed contours, counter-clockwise, whose local shape does not depend on their
// number of blocks: time against length shows the method, not the density. mm.
struct Workload {
  std::string name{};
  double tool_radius = 0;  // outwards
  std::vector<Segment> (*contour)(std::size_t blocks) = nullptr;
};

// wave: a ring with waves 10 mm long and 1 mm high, 100 lines each; radius 1 leaves no
//   loop, 5 one in every trough, 50 lets the troughs vanish.
// comb: slots 1 mm wide, 10 mm deep, between teeth of 4 mm; combfine: lines of 0.25 mm.
// rough: a ring of lines of 0.01 mm with 0.005 mm of noise, the radius a hundred times that.
// gear: lines and arcs, tangential; radius 3 loops in every valley.
// spiral: one arm whose walls are 1 mm apart, and half of all blocks.
[[nodiscard]] std::span<const Workload> workloads();

// Closed contours, counter-clockwise, that nobody has drawn for it. Outwards, begun where they are
// farthest from the zero point.
struct RealShapes {
  std::string name{};
  double tool_radius = 0;
  std::vector<std::vector<Segment>> (*contours)() = nullptr;  // throws where they are not installed
};

// letters: capitals of 40 mm, small letters and digits of three fonts, engraved one by one.
// coast: the longest one, a degree of the globe a centimetre, every turn a few micrometres long.
[[nodiscard]] std::span<const RealShapes> real_shapes();

}  // namespace trc::bench
