#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "proto/wire/block.h"
#include "proto/wire/setup.h"

namespace trc::fuzz {

// A whole path that the bytes of a fuzzer choose: every setting and every kind of item, with places
// that meet each other often enough to be hard.
struct FuzzedPath {
  wire::PathSettings settings{};
  std::vector<wire::PathInput> items{};
  // After how many items the caller cuts.
  std::size_t cut = 1;
};

[[nodiscard]] FuzzedPath fuzzed_path(std::span<const std::uint8_t> bytes);

}  // namespace trc::fuzz
