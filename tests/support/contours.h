#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/state/trc_mode.h"
#include "tests/support/random.h"

namespace trc::support {

// One selection as it is programmed: the approach block, the blocks of the
// contour and the retract block, each starting where the one before ends.
struct Contour {
  Line approach{};
  std::vector<Segment> blocks{};
  Line retract{};
};

// What a random contour is made of. Lengths are in tool radii.
enum class Flavor {
  mixed,         // lines and arcs, any turn, now and then a reversal or a full circle
  lines,         // lines alone, any turn
  near_tangent,  // turns of 1e-5 … 1e-2 rad, and none at all
  short_blocks,  // blocks down to a hundredth of the radius, small turns
  grid,          // whole-number coordinates, right angles, quarter circles: every tie happens
  convex,        // turns away from the tool only, at most half round
};

inline constexpr Flavor all_flavors[] = {Flavor::mixed,        Flavor::lines, Flavor::near_tangent,
                                         Flavor::short_blocks, Flavor::grid,  Flavor::convex};

[[nodiscard]] std::string name_of(Flavor flavor);

// A contour of 1 … `longest` blocks for a tool of `mode.tool_radius` on
// `mode.side`. It may well be impossible to machine.
[[nodiscard]] Contour random_contour(Random& random, Flavor flavor, const TrcMode& mode,
                                     std::size_t longest);

// A random contour without contour violations of rule 6 as the slow computation (slow_trc.h) sees
// them: blocks that would bring one in are left out.
[[nodiscard]] Contour random_clean_contour(Random& random, Flavor flavor, const TrcMode& mode,
                                           std::size_t longest);

// Side, radius, G138 / G139 / G239, G25 / G26 and STRETCH_FACTOR at random.
[[nodiscard]] TrcMode random_mode(Random& random);

// A map of the plane that keeps lengths: first the mirror at the second axis
// (x becomes -x), then the turn about the origin, then the shift.
struct Motion {
  bool mirrored = false;
  double turn = 0;  // rad, counter-clockwise
  Vector shift = Vector::Zero();

  [[nodiscard]] Point operator()(const Point& point) const;
  [[nodiscard]] Segment operator()(const Segment& segment) const;
  [[nodiscard]] Contour operator()(const Contour& contour) const;
};

// Travelled from its end to its start.
[[nodiscard]] Segment reversed(const Segment& segment);
[[nodiscard]] Contour reversed(const Contour& contour);

[[nodiscard]] Side other(Side side);

// Points of a segment: t = 0 is the start, t = 1 the end.
[[nodiscard]] Point point_at(const Segment& segment, double t);

// As NC text with all digits, so that a failing random contour can be kept.
std::ostream& operator<<(std::ostream& out, const Contour& contour);
[[nodiscard]] std::string text_of(const TrcMode& mode);

}  // namespace trc::support
