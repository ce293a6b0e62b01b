#pragma once

#include <cstdint>

namespace trc {

inline constexpr double mm_per_inch = 25.4;

// The unit that lengths of a program count in.
enum class LengthUnit : std::uint8_t { mm, inch };

// The unit as a length, mm.
[[nodiscard]] constexpr double mm_of(LengthUnit unit) {
  return unit == LengthUnit::inch ? mm_per_inch : 1;
}

}  // namespace trc
