#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "core/trc/result/compensated_block.h"
#include "proto/wire/block.h"

namespace trc::wire {

// One path input of every kind, each field of it set at least once.
[[nodiscard]] std::vector<PathInput> every_path_input();
// Random path inputs for two tracking axes; the same seed gives the same ones.
[[nodiscard]] std::vector<PathInput> random_path_inputs(std::uint64_t seed, std::size_t count);

// One compensated block of every origin and shape, in every plane, connected.
[[nodiscard]] std::vector<CompensatedBlock> every_compensated_block();
// Random connected compensated blocks with helices, text and tracking axes.
[[nodiscard]] std::vector<CompensatedBlock> random_compensated_blocks(std::uint64_t seed,
                                                                      std::size_t count);

// Equality down to the bits of each number; on a difference the first one in words.
[[nodiscard]] ::testing::AssertionResult same(const PathInput& a, const PathInput& b);
[[nodiscard]] ::testing::AssertionResult same(const CompensatedBlock& a, const CompensatedBlock& b);

}  // namespace trc::wire
