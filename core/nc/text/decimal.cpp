#include "core/nc/text/decimal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

namespace trc {

namespace decimal {
namespace {

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Whole numbers up to this one are exact too, so that one division rounds correctly.
constexpr std::uint64_t largest_exact = std::uint64_t{1} << 53;
constexpr std::size_t digits_that_fit = 19;  // in 64 bits

// Moves `at` past the digits and appends them to `number`, which wraps beyond `digits_that_fit`.
void take_digits(const char*& at, const char* end, std::uint64_t& number) {
  for (; at != end; ++at) {
    const auto digit = static_cast<unsigned char>(*at - '0');
    if (digit > 9) return;
    number = number * 10 + digit;
  }
}

// For numbers that need more than 64 bits or one division.
double read_by_library(const char* first, const char* end) {
  double value = 0;
  if (std::from_chars(first, end, value, std::chars_format::fixed).ec !=
      std::errc::result_out_of_range)
    return value;
  const char* const point = std::find(first, end, '.');
  const bool large = std::any_of(first, point, [](char digit) { return digit != '0'; });
  return large ? std::numeric_limits<double>::infinity() : 0;
}

}  // namespace

std::uint64_t bytes_of_short_line(const char* at, std::size_t left) {
  std::array<char, 8> bytes{};
  std::memcpy(bytes.data(), at, left);
  return eight_bytes(bytes.data());
}

AnyNumber any_number(const char* first, const char* end) {
  std::uint64_t digits = 0;
  const char* at = first;
  take_digits(at, end, digits);
  auto size = static_cast<std::size_t>(at - first);
  std::size_t decimals = 0;
  if (at != end && *at == '.') {
    const char* const behind_point = ++at;
    take_digits(at, end, digits);
    decimals = static_cast<std::size_t>(at - behind_point);
    size += decimals;
  }
  if (size > digits_that_fit || digits > largest_exact) return {read_by_library(first, at), at};
  return {static_cast<double>(static_cast<std::int64_t>(digits)) / powers_of_ten[decimals], at};
}

}  // namespace decimal

std::size_t read_number(std::string_view text, double& value, bool& whole) {
  const char* at = text.data();
  if (!take_number(text, at, value, whole)) return 0;
  return static_cast<std::size_t>(at - text.data());
}

std::size_t read_named_number(std::string_view text, double& value, bool& whole) {
  const std::size_t length = read_number(text, value, whole);
  const std::string_view behind = text.substr(length);
  if (length == 0 || behind.size() < 3 || upper(behind[0]) != 'E' || upper(behind[1]) != 'X')
    return length;
  double exponent = 0;
  bool is_whole_exponent = false;
  const std::size_t digits = read_number(behind.substr(2), exponent, is_whole_exponent);
  if (digits == 0 || !is_whole_exponent) return length;
  value = exponent < 0 ? value / std::pow(10.0, -exponent) : value * std::pow(10.0, exponent);
  return length + 2 + digits;
}

}  // namespace trc
