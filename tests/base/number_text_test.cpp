#include "core/base/number_text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace trc {
namespace {

TEST(NumberText, IsTheFewestDigitsThatReadBackToTheSameNumber) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-2.0), "-2");
  EXPECT_EQ(shortest(1e25), "1e+25");
  EXPECT_EQ(shortest(0.1 + 0.2), "0.30000000000000004");
}

TEST(NumberText, HasRoomForTheLongestNumbers) {
  for (const double number : {-std::numeric_limits<double>::min(),
                              -std::numeric_limits<double>::max(), -1.0 / 3 * 1e-300})
    EXPECT_EQ(std::stod("0" + shortest(number).substr(1)), -number);
  EXPECT_EQ(shortest(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
}

}  // namespace
}  // namespace trc
