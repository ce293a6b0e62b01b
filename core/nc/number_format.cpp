#include "core/nc/number_format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace trc {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr Wide most_units = std::numeric_limits<std::int64_t>::max();

// A blank, a letter, a sign, an integer part of up to 19 digits, the point and the decimals.
constexpr std::size_t longest_word = 40;

// "00" to "99": digits are made two at a time.
constexpr auto digit_pairs = [] {
  std::array<std::array<char, 2>, 100> pairs{};
  for (std::size_t pair = 0; pair < pairs.size(); ++pair)
    pairs[pair] = {static_cast<char>('0' + pair / 10), static_cast<char>('0' + pair % 10)};
  return pairs;
}();

// These write backwards, in front of `end`, and return where the text begins.
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
  std::uint64_t digits = units < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(units)
                                   : static_cast<std::uint64_t>(units);
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

}  // namespace

std::int64_t to_units(double value, int decimals) {
  // value = mantissa * 2^exponent exactly; the product with the power of ten
  // takes at most 53 + 30 bits, so that only the final shift rounds.
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

void append_units(std::string& out, std::int64_t units, int decimals) {
  std::array<char, longest_word> text;
  char* const end = text.data() + text.size();
  out.append(write_number(units, decimals, Zeros::trimmed, end), end);
}

void append_fixed(std::string& out, double value, int decimals) {
  std::array<char, longest_word> text;
  char* const end = text.data() + text.size();
  out.append(write_number(to_units(value, decimals), decimals, Zeros::kept, end), end);
}

void append_word(std::string& out, char letter, std::int64_t units, int decimals) {
  std::array<char, longest_word> text;
  char* const end = text.data() + text.size();
  char* begin = write_number(units, decimals, Zeros::trimmed, end);
  *--begin = letter;
  *--begin = ' ';
  out.append(begin, end);
}

}  // namespace trc
