#pragma once

#include "core/trc/corner/corner.h"
#include "core/trc/path_block.h"

namespace trc {

// Whether the short way knows all that the mode asks for between two blocks in the middle of a
// contour.
[[nodiscard]] bool is_plain(const TrcMode& mode, Loops loops);

// Whether the block is in the middle of a contour, under one compensation, and nothing else.
[[nodiscard]] bool is_plain(const PathBlock& block);

}  // namespace trc
