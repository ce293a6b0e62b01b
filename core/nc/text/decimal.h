#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace trc {

// Reading the decimal numbers of a line: the hottest loop of the reader.
namespace decimal {

// Powers of ten that a double holds exactly.
inline constexpr std::array<double, 23> powers_of_ten{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Whole numbers up to here are exact too, so that one division rounds correctly.
inline constexpr std::uint64_t largest_exact = std::uint64_t{1} << 53;
inline constexpr std::size_t digits_that_fit = 19;  // in 64 bits

// Moves `at` behind the digits there and appends them to `number`, which wraps beyond
// `digits_that_fit`.
inline void take_digits(const char*& at, const char* end, std::uint64_t& number) {
  for (; at != end; ++at) {
    const auto digit = static_cast<unsigned char>(*at - '0');
    if (digit > 9) return;
    number = number * 10 + digit;
  }
}

// What eight bytes can hold with the sign that ends them.
inline constexpr std::size_t short_digits = 7;
inline constexpr std::uint64_t short_scale = 100'000'000;

// Eight bytes, the first one lowest.
inline std::uint64_t eight_bytes(const char* at) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
  return bytes;
}

// The bytes of `line` from `at` on, zeros behind its end.
inline std::uint64_t next_bytes(std::string_view line, const char* at) {
  constexpr std::size_t size = 8;
  const auto left = static_cast<std::size_t>(line.data() + line.size() - at);
  if (left >= size) return eight_bytes(at);
  if (left == 0) return 0;
  if (line.size() >= size) return eight_bytes(at + left - size) >> (8 * (size - left));
  std::array<char, size> bytes{};
  std::memcpy(bytes.data(), at, left);
  return eight_bytes(bytes.data());
}

// The number of eight digits, the first one lowest: pairs, then fours, then all of them.
inline std::uint64_t number_of(std::uint64_t digits) {
  digits = (digits * (10 * 0x100 + 1)) >> 8 & 0x00ff'00ff'00ff'00ff;
  digits = (digits * (100 * 0x1'0000 + 1)) >> 16 & 0x0000'ffff'0000'ffff;
  return digits * (10'000 * 0x1'0000'0000 + 1) >> 32;
}

// The digits at some place of a line, if they are up to `short_digits`.
class ShortDigits {
 public:
  ShortDigits(std::string_view line, const char* at)
      : bytes_(next_bytes(line, at) ^ 0x3030'3030'3030'3030),
        // The top bit of a byte is set where it is above 9; a carry only reaches bytes behind such
        // a one.
        others_((bytes_ | (bytes_ + 0x7676'7676'7676'7676)) & 0x8080'8080'8080'8080),
        end_(static_cast<unsigned>(std::countr_zero(others_))) {}

  [[nodiscard]] bool are_short() const { return others_ != 0; }
  [[nodiscard]] unsigned count() const { return end_ / 8; }
  // With zeros in front.
  [[nodiscard]] std::uint64_t number() const { return number_of(bytes_ << 8 << (63 - end_)); }
  // With zeros behind: times `short_scale`.
  [[nodiscard]] std::uint64_t fraction() const {
    return number_of(bytes_ & (others_ ^ (others_ - 1)) >> 8);
  }

 private:
  std::uint64_t bytes_;   // less '0' each
  std::uint64_t others_;  // the top bit of the first byte that is no digit, and of some behind it
  unsigned end_;          // the place of that bit
};

// As take_digits, for a number that begins there.
inline std::uint64_t take_whole(std::string_view line, const char*& at) {
  const ShortDigits few(line, at);
  if (few.are_short()) {
    at += few.count();
    return few.number();
  }
  std::uint64_t number = 0;
  take_digits(at, line.data() + line.size(), number);
  return number;
}

// For what 64 bits or one division cannot give: digits with or without a point.
[[nodiscard]] double long_number(const char* first, const char* end);

// A number of many digits, from `first` on; `digits` are those up to the point, where `at` is.
inline double take_long_fraction(const char* first, const char*& at, const char* end,
                                 std::uint64_t digits) {
  const char* const point = at++;
  take_digits(at, end, digits);
  const auto size = static_cast<std::size_t>(at - first) - 1;
  if (size > digits_that_fit || digits > largest_exact) return long_number(first, at);
  const auto decimals = static_cast<std::size_t>(at - point) - 1;
  return static_cast<double>(static_cast<std::int64_t>(digits)) / powers_of_ten[decimals];
}

}  // namespace decimal

// Moves `at` behind the number there: sign, digits, point; false when there is none. `whole`: it
// has no point. Infinite when it is larger than any double, else correctly rounded: where the
// digits as a whole number and the power of ten that they are divided by are exact as doubles, one
// division rounds once, and it does not matter which of the powers that leave a whole number is
// taken. All others are left to the standard library.
inline bool take_number(std::string_view line, const char*& at, double& value, bool& whole) {
  const char* const end = line.data() + line.size();
  const char* here = at;
  const bool negative = here != end && *here == '-';
  if (here != end && (*here == '-' || *here == '+')) ++here;
  const char* const first = here;

  const std::uint64_t digits = decimal::take_whole(line, here);
  const auto size = static_cast<std::size_t>(here - first);
  whole = here == end || *here != '.';
  if (whole) {
    if (size == 0) return false;
    // Signed, which converts in one instruction.
    value = size <= decimal::digits_that_fit && digits <= decimal::largest_exact
                ? static_cast<double>(static_cast<std::int64_t>(digits))
                : decimal::long_number(first, here);
  } else {
    const decimal::ShortDigits few(line, here + 1);
    if (size <= decimal::short_digits && few.are_short()) {
      value = static_cast<double>(
                  static_cast<std::int64_t>(digits * decimal::short_scale + few.fraction())) /
              static_cast<double>(decimal::short_scale);
      here += 1 + few.count();
    } else {
      value = decimal::take_long_fraction(first, here, end, digits);
    }
    if (here - first == 1) return false;
  }
  if (negative) value = -value;
  at = here;
  return true;
}

}  // namespace trc
