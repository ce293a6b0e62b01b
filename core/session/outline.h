#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// A movement in `plane` with its travel across that plane, seen from the third
// axis of `view`. In its own plane it stays what it is; elsewhere arcs become
// chords no longer than 3 degrees, and a movement straight at the viewer
// becomes nothing.
[[nodiscard]] std::vector<Segment> project(Plane plane, const Segment& segment,
                                           const AxisTravel& normal, Plane view);

// Contour blocks the tool does not travel, as the notes name them. A transition behind such a block
// may be travelled all the same.
class NotTravelled {
 public:
  explicit NotTravelled(std::span<const Diagnostic> diagnostics);

  [[nodiscard]] bool contains(std::uint64_t index) const;

 private:
  using Range = std::pair<std::uint64_t, std::uint64_t>;
  std::vector<Range> ranges_{};  // apart from each other, in order
};

}  // namespace trc
