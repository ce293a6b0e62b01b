#pragma once

#include <optional>

#include "core/nc/state/trc_mode.h"
#include "core/verify/piece.h"

namespace trc::verify {

// A path on the other side of its own block than the program asks for.
struct WrongSide {
  Point middle = Point::Zero();  // of the path
  double apart = 0;              // mm, of the middle from the block
};
// Nothing: its middle lies on that side.
[[nodiscard]] std::optional<WrongSide> on_wrong_side(const Piece& path, const Piece& own,
                                                     Side side);

}  // namespace trc::verify
