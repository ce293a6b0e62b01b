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
inline constexpr int default_decimals = 4;  // of mm

inline constexpr std::array<std::int64_t, most_decimals + 1> units_per_one_by_decimals{
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

// 10 to the power of `decimals`, 0 <= decimals <= most_decimals.
[[nodiscard]] constexpr std::int64_t units_per_one(int decimals) {
  return units_per_one_by_decimals[static_cast<std::size_t>(decimals)];
}

// `value` in units of its last decimal, rounded from the exact value of the
// double, ties to even: the digits printf("%.*f") gives. What does not fit
// becomes the nearest number that does; `value` is not NaN.
[[nodiscard]] std::int64_t to_units_exactly(double value, int decimals);

// The same, in a few instructions for nearly all numbers. The product of a number below 2^41 and a
// power of ten, which is exact, is wrong by less than 2^-11: where it is no nearer than 2^-10 to
// the middle between two integers, the exact product has the same nearest integer, and is no tie.
[[nodiscard]] inline std::int64_t to_units(double value, int decimals) {
  constexpr double largest = 0x1p41;
  constexpr double to_integer = 0x1.8p52;  // a sum with it has no bits after the point
  const double units = value * static_cast<double>(units_per_one(decimals));
  const double nearest = (units + to_integer) - to_integer;
  const double away = units - nearest;
  if (units < largest && units > -largest && away < 0.5 - 0x1p-10 && away > -(0.5 - 0x1p-10))
    return static_cast<std::int64_t>(nearest);
  return to_units_exactly(value, decimals);
}

// The double a reader makes of the written number: the nearest one.
[[nodiscard]] constexpr double from_units(std::int64_t units, int decimals) {
  return static_cast<double>(units) / static_cast<double>(units_per_one(decimals));
}

// "30", "-0.5", "12.0001": no trailing zeros, no sign at zero.
void append_units(std::string& out, std::int64_t units, int decimals);

// The longest number of append_units, and what is written beyond it on the way.
inline constexpr std::size_t room_of_units = 32;

// As append_units, where there is room for `room_of_units` bytes. Returns the end of the number.
[[nodiscard]] char* write_units(char* at, std::int64_t units, int decimals);

// "30.0000": all decimals, no sign at zero.
void append_fixed(std::string& out, double value, int decimals);

}  // namespace trc
