#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/buffer_judge.h"

namespace trc::support {

// Closed polygons that nobody has drawn for loop removal, gone round with a tool.

// Begun in the middle of an edge where the tool has room; none where there is none. Coordinates
// are rounded to three decimals. `ring` does not repeat its first point.
[[nodiscard]] std::vector<Segment> begun_with_room(std::vector<Point> ring, const TrcMode& mode);

// A selection by the shortest way, with everything removed that the tool cannot reach.
[[nodiscard]] TrcMode mode_of_ring(double radius, Side side, Transition transition);

// What a judge has seen so far.
struct Tally {
  std::size_t compared = 0;
  std::size_t refused = 0;
  std::size_t different = 0;

  // A neck as wide as the tool may be open here and closed there: one of 200.
  [[nodiscard]] bool agrees() const { return 200 * different <= compared; }
  [[nodiscard]] std::string text() const;
};

// Compensates a closed contour and compares it with what GEOS makes of it; a contour that runs
// over itself is passed by. A path nearer than the radius fails the test, and a refusal where GEOS
// leaves a piece at the first point. Of mitres the distance alone is judged.
void judge(Geos& geos, const std::vector<Segment>& edges, const TrcMode& mode, Tally& tally);

}  // namespace trc::support
