#pragma once

#include "core/trc/corner/corner.h"
#include "core/trc/path_block.h"

namespace trc {

// Whether the short way supports everything that the mode asks for between two blocks within a
// contour.
[[nodiscard]] bool is_plain(const TrcMode& mode, Loops loops);

// Whether the block is within a contour, under one compensation, with nothing special about it.
[[nodiscard]] bool is_plain(const PathBlock& block);

}  // namespace trc
