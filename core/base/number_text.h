#pragma once

#include <array>
#include <charconv>
#include <string>

namespace trc {

// The fewest digits that read back to the same number, whatever the locale: 0.1, 1e+25.
template <class Number>
[[nodiscard]] std::string shortest(Number number) {
  std::array<char, 32> digits{};
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), written.ptr};
}

}  // namespace trc
