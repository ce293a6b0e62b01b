#pragma once

#include <cstddef>

#include "core/trc/result/compensated_block.h"
#include "proto/wire/setup.h"

namespace trc::wire {

// How many bytes a compensated block takes at most in a message of this layout: told before it is
// converted.
[[nodiscard]] std::size_t most_bytes(const CompensatedBlock& block, Layout layout);

}  // namespace trc::wire
