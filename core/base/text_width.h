#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace trc {

// The width of UTF-8 on a screen: letters of more than one byte count once.
[[nodiscard]] inline std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char letter) { return (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U; }));
}

}  // namespace trc
