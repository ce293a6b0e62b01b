#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace trc {

// Decimal numbers of NC text and listings, in units of the last decimal. Written
// numbers are integers of these units, so that sums and differences of them are
// exact.
inline constexpr int most_decimals = 9;

inline constexpr double mm_per_inch = 25.4;

// 10 to the power of `decimals`, 0 <= decimals <= most_decimals.
[[nodiscard]] constexpr std::int64_t units_per_one(int decimals) {
  constexpr std::array<std::int64_t, most_decimals + 1> powers_of_ten{
      1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
  return powers_of_ten[static_cast<std::size_t>(decimals)];
}

// `value` in units of its last decimal, rounded from the exact value of the
// double, ties to even: the digits printf("%.*f") gives. What does not fit
// becomes the nearest number that does; `value` is not NaN.
[[nodiscard]] std::int64_t to_units(double value, int decimals);

// The double a reader makes of the written number: the nearest one.
[[nodiscard]] constexpr double from_units(std::int64_t units, int decimals) {
  return static_cast<double>(units) / static_cast<double>(units_per_one(decimals));
}

// "30", "-0.5", "12.0001": no trailing zeros, no sign at zero.
void append_units(std::string& out, std::int64_t units, int decimals);

// " X30", " Y-0.5": a blank, the address letter and the number.
void append_word(std::string& out, char letter, std::int64_t units, int decimals);

// "30.0000": all decimals, no sign at zero.
void append_fixed(std::string& out, double value, int decimals);

}  // namespace trc
