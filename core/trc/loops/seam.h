#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/tolerances.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/walked_path.h"

namespace trc {

// The point where a closed contour begins and ends (rule 5.4): the kink that rounding leaves there
// is no violation, and the way from its first blocks to its last ones is no loop. The first and the
// last point of the path cannot move.
class Seam {
 public:
  Seam(const HeldPath& path, const Tolerances& tolerances) : path_(path), tolerances_(tolerances) {}

  // Whether the place counts as the first point of the path, or as the last one.
  [[nodiscard]] bool is_near(const PathPlace& place) const;
  // Whether a loop from one place to another, both at `point`, is the whole contour: the path
  // crosses its corner of the last and the first block, or rests of short blocks there.
  [[nodiscard]] bool is_between(const PathPlace& from, const PathPlace& to,
                                const Point& point) const;

 private:
  // Whether the first and the last point of the contour are one, as far as it is known.
  [[nodiscard]] bool is_closed() const;
  [[nodiscard]] bool is_at_end(const PathPlace& place) const;
  // Whether these contour blocks, with `rest` mm more of one, have room for the tool between them:
  // a room whose neck is at the seam.
  [[nodiscard]] bool encloses_room(std::size_t first, std::size_t end, double rest) const;
  // Largest distance from the first and the last point of the path, mm and blocks. A kink of 0.02,
  // as rounding makes it between blocks of 0.15 mm, cuts R·tan(0.01) of both; tools below 0.1 mm
  // have the resolution of programs.
  [[nodiscard]] double reach() const {
    constexpr double share_of_radius = 0.01;
    constexpr double least_radius = 0.1;
    return share_of_radius * std::max(path_.radius_of_tool(0), least_radius);
  }
  static constexpr std::size_t most_blocks = 64;

  const HeldPath& path_;
  Tolerances tolerances_;
};

}  // namespace trc
