#include "core/nc/text/number_format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace trc {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr Wide most_units = std::numeric_limits<std::int64_t>::max();

// A sign, up to 19 digits, or a zero and all decimals, and the point.
constexpr std::size_t longest_number = 24;

// "00" to "99": two digits are written at a time.
constexpr auto digit_pairs = [] {
  std::array<std::array<char, 2>, 100> pairs{};
  for (std::size_t pair = 0; pair < pairs.size(); ++pair)
    pairs[pair] = {static_cast<char>('0' + pair / 10), static_cast<char>('0' + pair % 10)};
  return pairs;
}();

std::uint64_t magnitude_of(std::int64_t units) {
  const auto bits = static_cast<std::uint64_t>(units);
  return units < 0 ? std::uint64_t{0} - bits : bits;
}

// These functions write backwards from `end` and return the beginning of the text.
char* write_pair(std::uint64_t& digits, char* end) {
  const std::array<char, 2>& pair = digit_pairs[digits % 100];
  digits /= 100;
  *--end = pair[1];
  *--end = pair[0];
  return end;
}

char* write_digit(std::uint64_t& digits, char* end) {
  *--end = static_cast<char>('0' + digits % 10);
  digits /= 10;
  return end;
}

enum class Zeros { trimmed, kept };

char* write_number(std::int64_t units, int decimals, Zeros zeros, char* end) {
  std::uint64_t digits = magnitude_of(units);
  if (zeros == Zeros::trimmed) {
    for (; decimals > 0 && digits % 10 == 0; --decimals) digits /= 10;
  }
  if (decimals > 0) {
    if (decimals % 2 != 0) end = write_digit(digits, end);
    for (int left = decimals / 2; left > 0; --left) end = write_pair(digits, end);
    *--end = '.';
  }
  const bool below_ten = digits < 10;
  while (digits >= 10) end = write_pair(digits, end);
  if (below_ten || digits > 0) end = write_digit(digits, end);
  if (units < 0) *--end = '-';
  return end;
}

// For numbers of any size.
char* write_long_number(char* at, std::int64_t units, int decimals) {
  char* const end = at + room_of_units;
  const char* const begin = write_number(units, decimals, Zeros::trimmed, end);
  const auto size = static_cast<std::size_t>(end - begin);
  std::memmove(at, begin, size);
  return at + size;
}

constexpr int digits_at_once = 8;
constexpr std::uint64_t beyond_digits_at_once = 100'000'000;

// The eight digits of a number below `beyond_digits_at_once`, one per byte, the first digit lowest:
// fours, then pairs, then digits. The factors divide numbers below 10000 and 100 exactly.
std::uint64_t eight_digits(std::uint64_t number) {
  const std::uint64_t first_four = number / 10'000;
  const std::uint64_t fours = first_four | (number - 10'000 * first_four) << 32;
  const std::uint64_t hundreds = fours * 10'486 >> 20 & 0x0000'007f'0000'007f;
  const std::uint64_t pairs = hundreds | (fours - 100 * hundreds) << 16;
  const std::uint64_t tens = pairs * 103 >> 10 & 0x000f'000f'000f'000f;
  return tens | (pairs - 10 * tens) << 8;
}

// Writes digits as text; missing digits become zeros.
void store_digits(char* at, std::uint64_t digits) {
  digits += 0x3030'3030'3030'3030;
  if constexpr (std::endian::native == std::endian::big) digits = __builtin_bswap64(digits);
  std::memcpy(at, &digits, sizeof digits);
}

enum class Front { first_digits, more_digits };

// Writes a number of up to eight digits, fewer than eight of them `decimals`, without trailing
// zeros. If the first digits have been written before these, leading zeros are written too; else
// only the last one before the point is.
char* write_eight_digits(char* at, std::uint64_t number, int decimals, Front front) {
  const std::uint64_t digits = eight_digits(number);
  const int whole = digits_at_once - decimals;
  constexpr std::uint64_t last_digit = std::uint64_t{1} << 56;
  const int zeros = front == Front::more_digits
                        ? 0
                        : std::min(std::countr_zero(digits | last_digit) / 8, whole - 1);
  store_digits(at, digits >> (8 * zeros));
  at += whole - zeros;
  const int end = digits_at_once - std::countl_zero(digits) / 8;
  if (end <= whole) return at;
  *at++ = '.';
  store_digits(at, digits >> (8 * whole));
  return at + (end - whole);
}

}  // namespace

std::int64_t to_units_exactly(double value, int decimals) {
  // value = mantissa * 2^exponent exactly; the product with the power of ten takes at most 53 + 30
  // bits, so that only the final shift rounds.
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t fraction = bits & 0xf'ffff'ffff'ffff;
  const std::uint64_t mantissa = biased == 0 ? fraction : fraction | (std::uint64_t{1} << 52);
  const int exponent = (biased == 0 ? 1 : biased) - 1075;
  const Wide product = Wide{mantissa} * static_cast<std::uint64_t>(units_per_one(decimals));

  Wide units = 0;
  if (exponent >= 0) {
    units = exponent < 10 ? product << exponent : most_units;
  } else if (exponent > -127) {
    const int shift = -exponent;
    const Wide rest = product & ((Wide{1} << shift) - 1);
    const Wide half = Wide{1} << (shift - 1);
    units = product >> shift;
    if (rest > half || (rest == half && (units & 1) != 0)) ++units;
  }
  const auto magnitude = static_cast<std::int64_t>(std::min(units, most_units));
  return (bits >> 63) != 0 ? -magnitude : magnitude;
}

char* write_units(char* at, std::int64_t units, int decimals) {
  const std::uint64_t digits = magnitude_of(units);
  const std::uint64_t first_digits = digits / beyond_digits_at_once;
  if (decimals >= digits_at_once || first_digits >= beyond_digits_at_once)
    return write_long_number(at, units, decimals);
  if (units < 0) *at++ = '-';
  if (first_digits == 0) return write_eight_digits(at, digits, decimals, Front::first_digits);
  if (first_digits < 10) {
    *at++ = static_cast<char>('0' + first_digits);
  } else {
    at = write_eight_digits(at, first_digits, 0, Front::first_digits);
  }
  return write_eight_digits(at, digits - beyond_digits_at_once * first_digits, decimals,
                            Front::more_digits);
}

void append_units(std::string& out, std::int64_t units, int decimals) {
  std::array<char, room_of_units> text;
  out.append(text.data(), write_units(text.data(), units, decimals));
}

void append_fixed(std::string& out, double value, int decimals) {
  std::array<char, longest_number> text;
  char* const end = text.data() + text.size();
  out.append(write_number(to_units(value, decimals), decimals, Zeros::kept, end), end);
}

}  // namespace trc
