#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/trc/result/compensated_block.h"

namespace trc::wire {

// Appends the bytes of the CompensatedBatch that to_proto() would fill: the same, without a message
// for every block and its points, which take five sixths of the time.
void append_batch(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
                  std::string& bytes);

}  // namespace trc::wire
