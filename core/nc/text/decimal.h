#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace trc {

// Reading the decimal numbers of a line: the hottest loop of the reader.
namespace decimal {

inline constexpr std::uint64_t short_scale = 100'000'000;

// Eight bytes, the first one lowest.
inline std::uint64_t eight_bytes(const char* at) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
  return bytes;
}

// For a line shorter than eight bytes, with `left` bytes from `at` on. A function of its own: its
// array makes the compiler guard the stack.
[[nodiscard]] std::uint64_t bytes_of_short_line(const char* at, std::size_t left);

// The bytes of `line` from `at` on, zeros past its end.
inline std::uint64_t next_bytes(std::string_view line, const char* at) {
  constexpr std::size_t size = 8;
  const auto left = static_cast<std::size_t>(line.data() + line.size() - at);
  if (left >= size) return eight_bytes(at);
  if (left == 0) return 0;
  if (line.size() >= size) return eight_bytes(at + left - size) >> (8 * (size - left));
  return bytes_of_short_line(at, left);
}

// The number of eight digits, the first one lowest: pairs, then fours, then all of them.
inline std::uint64_t number_of(std::uint64_t digits) {
  digits = (digits * (10 * 0x100 + 1)) >> 8 & 0x00ff'00ff'00ff'00ff;
  digits = (digits * (100 * 0x1'0000 + 1)) >> 16 & 0x0000'ffff'0000'ffff;
  return digits * (10'000 * 0x1'0000'0000 + 1) >> 32;
}

// Up to seven digits at some place of a line: eight bytes that also hold the sign after the
// digits.
class ShortDigits {
 public:
  ShortDigits(std::string_view line, const char* at)
      : bytes_(next_bytes(line, at) ^ 0x3030'3030'3030'3030),
        // The top bit of a byte is set where it is above 9; a carry only reaches bytes after such
        // a one.
        others_((bytes_ | (bytes_ + 0x7676'7676'7676'7676)) & 0x8080'8080'8080'8080),
        end_(static_cast<unsigned>(std::countr_zero(others_))) {}

  [[nodiscard]] bool are_short() const { return others_ != 0; }
  [[nodiscard]] unsigned count() const { return end_ / 8; }
  // The digits with leading zeros.
  [[nodiscard]] std::uint64_t number() const { return number_of(bytes_ << 8 << (63 - end_)); }
  // The digits with trailing zeros: a fraction times `short_scale`.
  [[nodiscard]] std::uint64_t fraction() const {
    return number_of(bytes_ & (others_ ^ (others_ - 1)) >> 8);
  }

 private:
  std::uint64_t bytes_;   // less '0' each
  std::uint64_t others_;  // the top bit of the first byte that is no digit, and of some after it
  unsigned end_;          // the place of that bit
};

// A number of any length: digits with or without a point, from `first` on.
struct AnyNumber {
  double value = 0;
  const char* end = nullptr;
};
[[nodiscard]] AnyNumber any_number(const char* first, const char* end);

}  // namespace decimal

// Moves `at` past the number there: sign, digits, point; false when there is none. `whole`: it
// has no point. Infinite when it is larger than any double, else correctly rounded: where the
// digits as a whole number and the power of ten that they are divided by are exact as doubles, one
// division rounds once, and it does not matter which of the powers that leave a whole number is
// taken. All others are left to the standard library.
[[gnu::always_inline]] inline bool take_number(std::string_view line, const char*& at,
                                               double& value, bool& whole) {
  const char* const end = line.data() + line.size();
  const char* here = at;
  const bool negative = here != end && *here == '-';
  if (here != end && (*here == '-' || *here == '+')) ++here;
  const char* const first = here;

  double number = 0;
  bool is_long = false;
  const decimal::ShortDigits digits(line, here);
  here += digits.count();
  whole = here == end || *here != '.';
  if (!digits.are_short()) {
    is_long = true;
  } else if (whole) {
    if (digits.count() == 0) return false;
    // Signed, which converts in one instruction.
    number = static_cast<double>(static_cast<std::int64_t>(digits.number()));
  } else {
    const decimal::ShortDigits few(line, here + 1);
    is_long = !few.are_short();
    here += 1 + few.count();
    if (here - first == 1) return false;
    number = static_cast<double>(static_cast<std::int64_t>(digits.number() * decimal::short_scale +
                                                           few.fraction())) /
             static_cast<double>(decimal::short_scale);
  }
  if (is_long) {
    const decimal::AnyNumber any = decimal::any_number(first, end);
    number = any.value;
    here = any.end;
    whole = std::memchr(first, '.', static_cast<std::size_t>(here - first)) == nullptr;
  }
  value = negative ? -number : number;
  at = here;
  return true;
}

}  // namespace trc
