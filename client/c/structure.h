#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

// Structures that contain their own size, by the header that the caller was built with.

namespace trc::c {

// No structure is larger in any version: a larger size was never initialised.
inline constexpr std::size_t largest_structure = 4096;

[[nodiscard]] inline bool is_size(std::size_t size, std::size_t known) {
  return size >= known && size <= largest_structure;
}

// Whether the members that a newer header adds to a structure are all zero.
[[nodiscard]] inline bool is_zero_behind(const void* structure, std::size_t known,
                                         std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(structure);
  return std::all_of(bytes + known, bytes + size, [](unsigned char byte) { return byte == 0; });
}

// Copies into a structure of the caller, and keeps its size.
template <class Structure>
void write_out(const Structure& value, Structure& out) {
  const std::size_t size = out.size;
  std::memcpy(&out, &value, sizeof value);
  std::memset(reinterpret_cast<unsigned char*>(&out) + sizeof value, 0, size - sizeof value);
  out.size = size;
}

}  // namespace trc::c
