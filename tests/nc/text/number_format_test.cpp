#include "core/nc/text/number_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "tests/support/long_run.h"
#include "tests/support/random.h"

namespace trc::testing {
namespace {

std::string fixed(double value, int places) {
  std::string text;
  append_fixed(text, value, places);
  return text;
}

std::string trimmed(std::int64_t units, int places) {
  std::string text;
  append_units(text, units, places);
  return text;
}

// What the C library prints, without the sign of a number that has become zero.
std::string printed(double value, int places) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", places, value);
  std::string number = text;
  if (number.find_first_of("123456789") == std::string::npos && number[0] == '-')
    number.erase(0, 1);
  return number;
}

TEST(NumberFormat, HasNoTrailingZerosAndNoSignAtZero) {
  EXPECT_EQ(trimmed(0, 4), "0");
  EXPECT_EQ(trimmed(300000, 4), "30");
  EXPECT_EQ(trimmed(-5000, 4), "-0.5");
  EXPECT_EQ(trimmed(1, 4), "0.0001");
  EXPECT_EQ(trimmed(-1200100, 4), "-120.01");
  EXPECT_EQ(trimmed(7, 0), "7");
  EXPECT_EQ(trimmed(std::numeric_limits<std::int64_t>::min(), 0), "-9223372036854775808");
  EXPECT_EQ(fixed(-0.00001, 4), "0.0000");
  EXPECT_EQ(fixed(30, 4), "30.0000");
}

TEST(NumberFormat, TiesGoToEven) {
  EXPECT_EQ(fixed(0.5, 0), "0");
  EXPECT_EQ(fixed(1.5, 0), "2");
  EXPECT_EQ(fixed(0.125, 2), "0.12");
  EXPECT_EQ(fixed(0.375, 2), "0.38");
  EXPECT_EQ(fixed(-0.03125, 4), "-0.0312");
  // No ties: these doubles lie above and below.
  EXPECT_EQ(fixed(1.00005, 4), "1.0001");
  EXPECT_EQ(fixed(0.00015, 4), "0.0001");
}

TEST(NumberFormat, RoundsAsTheCLibraryDoes) {
  support::Random random(20);
  for (int i = 0; i < 300'000; ++i) {
    const auto places = static_cast<int>(random.below(most_decimals + 1));
    double value = 0;
    switch (random.below(4)) {
      case 0:  // decimal fractions
        value = std::round(random.between(-1e9, 1e9)) /
                static_cast<double>(units_per_one(static_cast<int>(random.below(10))));
        break;
      case 1:  // binary fractions: exact ties among them
        value =
            std::ldexp(std::round(random.between(-1e7, 1e7)), -static_cast<int>(random.below(30)));
        break;
      case 2:  // decimal ties, as near as doubles come
        value = std::round(random.between(-1e6, 1e6)) +
                (2 * std::round(random.between(0, 1000)) + 1) / 2 /
                    static_cast<double>(units_per_one(places));
        break;
      default:
        value = random.between(-1e6, 1e6);
    }
    ASSERT_EQ(fixed(value, places), printed(value, places)) << "seed 20, step " << i;
    ASSERT_EQ(from_units(to_units(value, places), places),
              std::strtod(printed(value, places).c_str(), nullptr));
  }
}

int numbers() { return support::is_long_run() ? 20'000'000 : 200'000; }

// A number whose last decimal is as near to a tie as a double can be, or any number.
double near_tie(support::Random& random, int places) {
  const double size = std::pow(10, random.between(0, 14 - places));
  double value = random.between(-size, size);
  if (random.chance(0.2)) return value;
  const auto unit = static_cast<double>(units_per_one(places));
  value = (std::floor(value * unit) + 0.5) / unit;
  for (auto steps = random.below(4); steps > 0; --steps)
    value = std::nextafter(value, random.chance(0.5) ? 1e300 : -1e300);
  return value;
}

TEST(NumberFormat, TheShortWayToUnitsIsExact) {
  constexpr std::uint64_t seed = 21;
  support::Random random(seed);
  for (int i = 0; i < numbers(); ++i) {
    const auto places = static_cast<int>(random.below(most_decimals + 1));
    const double value = near_tie(random, places);
    ASSERT_EQ(to_units(value, places), to_units_exactly(value, places))
        << value << " seed " << seed << ", step " << i;
  }
}

TEST(NumberFormat, UnitsAreWrittenAsTheCLibraryWritesThem) {
  constexpr std::uint64_t seed = 22;
  support::Random random(seed);
  for (int i = 0; i < numbers(); ++i) {
    const auto places = static_cast<int>(random.below(most_decimals + 1));
    auto units = static_cast<std::int64_t>(std::pow(10, random.between(0, 18.9)));
    // Zeros at the end, as programs have them.
    for (auto zeros = random.below(12); zeros > 0; --zeros) units = units / 10;
    for (auto zeros = random.below(8); zeros > 0 && units < 1'000'000'000; --zeros) units *= 10;
    if (random.chance(0.5)) units = -units;
    const auto one = units_per_one(places);
    char text[64];
    std::snprintf(text, sizeof text, "%s%lld", units < 0 ? "-" : "",
                  static_cast<long long>(std::abs(units / one)));
    std::string expected = text;
    if (const auto fraction = std::abs(units % one); fraction != 0) {
      std::snprintf(text, sizeof text, ".%0*lld", places, static_cast<long long>(fraction));
      expected += text;
      expected.erase(expected.find_last_not_of('0') + 1);
    }
    ASSERT_EQ(trimmed(units, places), expected) << "seed " << seed << ", step " << i;
  }
}

TEST(NumberFormat, ExtremesStayInRange) {
  const auto largest = std::numeric_limits<std::int64_t>::max();
  for (const double value :
       {1e19, 1e300, std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(to_units(value, 4), largest);
    EXPECT_EQ(to_units(-value, 4), -largest);
  }
  for (const double value : {0.0, -0.0, 5e-324, 1e-300, -1e-40, 1e-10}) {
    EXPECT_EQ(to_units(value, 9), 0) << value;
  }
  EXPECT_EQ(to_units(1e6, 9), 1'000'000'000'000'000);
}

}  // namespace
}  // namespace trc::testing
