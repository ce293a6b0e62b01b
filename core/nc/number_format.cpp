#include "core/nc/number_format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>

namespace trc {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::array<std::int64_t, most_decimals + 1> powers_of_ten{
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

constexpr Wide most_units = std::numeric_limits<std::int64_t>::max();

// An integer part of up to 19 digits, the point, the decimals and a sign.
constexpr std::size_t longest_number = 32;

enum class Zeros { trimmed, kept };

void append(std::string& out, std::int64_t units, int decimals, Zeros zeros) {
  std::array<char, longest_number> text;
  char* end = text.data();
  if (units < 0) *end++ = '-';
  const std::uint64_t magnitude = units < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(units)
                                            : static_cast<std::uint64_t>(units);
  const auto one = static_cast<std::uint64_t>(powers_of_ten[static_cast<std::size_t>(decimals)]);
  std::uint64_t fraction = magnitude % one;
  end = std::to_chars(end, text.data() + text.size(), magnitude / one).ptr;
  if (decimals > 0 && (fraction != 0 || zeros == Zeros::kept)) {
    *end++ = '.';
    for (int i = decimals; i-- > 0; fraction /= 10) end[i] = static_cast<char>('0' + fraction % 10);
    end += decimals;
    if (zeros == Zeros::trimmed) {
      while (end[-1] == '0') --end;
    }
  }
  out.append(text.data(), end);
}

}  // namespace

std::int64_t units_per_one(int decimals) {
  return powers_of_ten[static_cast<std::size_t>(decimals)];
}

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

double from_units(std::int64_t units, int decimals) {
  return static_cast<double>(units) / static_cast<double>(units_per_one(decimals));
}

void append_units(std::string& out, std::int64_t units, int decimals) {
  append(out, units, decimals, Zeros::trimmed);
}

void append_fixed(std::string& out, double value, int decimals) {
  append(out, to_units(value, decimals), decimals, Zeros::kept);
}

}  // namespace trc
