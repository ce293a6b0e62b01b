#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/config/config.h"

namespace trc::server {

// Fills in the limits that a configuration leaves open (0), from the memory that the process may
// use, and checks their sums: the memory of all streams together must fit. Returns the first sum
// that does not, as a sentence.
[[nodiscard]] std::optional<std::string> fill_in_limits(Config& config, std::uint64_t memory_bytes);

// fill_in_limits() for a server inside the process of its only client, which may use most memory.
[[nodiscard]] std::optional<std::string> fill_in_own_limits(Config& config,
                                                            std::uint64_t memory_bytes);

}  // namespace trc::server
