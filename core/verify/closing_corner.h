#pragma once

#include <cstdint>

#include "core/trc/result/refused_way.h"

namespace trc::verify {

enum class ClosingCorner : std::uint8_t {
  none,
  inside,
  other_side,  // the tool comes from the one side of the contour, and is to cut on the other
};

// Whether the contour closes in an inside corner, and whether the tool comes from the other side of
// it than it is to cut on: most often the other side is meant then (G41 against G42). `way`: the
// approach, and after it the whole contour, of lines and arcs, which closes where its ends are no
// farther apart than `input_resolution`, mm.
[[nodiscard]] ClosingCorner closing_corner(const RefusedWay& way, double input_resolution);

}  // namespace trc::verify
