#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::support {

// Closed contours without self-contact, counter-clockwise, of as many blocks as one
// likes: the kinds on which offsetting goes wrong or becomes slow.
enum class BigShape {
  wave,          // a ring with waves on it; a loop in every trough
  comb,          // a ring with slots narrower than the tool
  divided_comb,  // the same with its lines in many short pieces
  gear,          // a zigzag ring with rounded corners: lines and tangential arcs
  spiral,        // one long arm with a narrow gap, far neighbours along the contour
  rough,         // blocks far shorter than the tool, with noise
};

inline constexpr BigShape all_big_shapes[] = {BigShape::wave,         BigShape::comb,
                                              BigShape::divided_comb, BigShape::gear,
                                              BigShape::spiral,       BigShape::rough};

[[nodiscard]] std::string name_of(BigShape shape);

// About `blocks` blocks, for a tool of about 1 mm.
[[nodiscard]] std::vector<Segment> big_contour(BigShape shape, std::size_t blocks);

// The closed contour, begun in the middle of its block `first`.
[[nodiscard]] std::vector<Segment> begun_within(const std::vector<Segment>& contour,
                                                std::size_t first);

}  // namespace trc::support
