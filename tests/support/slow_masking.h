#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/state/trc_mode.h"
#include "tests/support/contours.h"

namespace trc::support {

// Removal of violating loops (rule 5.1) under G26, from the definition alone: every
// equidistant in full length and every transition arc, cut wherever the distance to
// any block of the contour passes through the tool radius; of the cut pieces those
// that keep their distance; and among them the way from the first compensated point
// to the last one that never goes back along the contour.
struct SlowMasking {
  struct Piece {
    Segment path{};
    // 1 … n; an inserted arc has that of the block it follows.
    std::size_t ordinal = 0;
    bool inserted = false;
  };
  // Empty where no such way exists: the contour cannot be machined.
  std::vector<Piece> path{};
  // The way was not the only one: pieces that keep their distance meet in one
  // point or run on top of each other, so that another way is as right.
  bool tied = false;
  // Somewhere an equidistant comes too near by less than twice the tolerance of
  // rule 5.1: whether it does come too near is a matter of taste.
  bool shallow = false;
  // Something is smaller than what decides anything in rounded input (D-44), of which the
  // definition knows nothing: a block below `input_resolution`, a bow tie, or the kink in the seam
  // of a closed contour.
  bool rounded = false;
};

// How strictly the words of rule 5.1 are taken.
struct MaskingScale {
  // A piece is kept if its distance to the contour is the radius at least; lenient:
  // less the tolerance.
  bool lenient = false;
  // So far from each other, mm, the ends of pieces still count as one point.
  double joint = 2e-7;
};

// The approach corner gets no inserted arc (G138).
[[nodiscard]] SlowMasking slow_masking(const Contour& contour, const TrcMode& mode,
                                       const MaskingScale& scale);

}  // namespace trc::support
