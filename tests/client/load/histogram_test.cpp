#include "client/load/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/random.h"

namespace trc::load {
namespace {

using Duration = Histogram::Duration;

// The smallest duration that a share of all does not exceed.
Duration exact(std::vector<Duration> sorted, double share) {
  std::sort(sorted.begin(), sorted.end());
  const auto rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

TEST(Histogram, TellsEveryPercentileToThreeDigits) {
  constexpr std::uint64_t seed = 20'261'121;
  SCOPED_TRACE("seed " + std::to_string(seed));
  support::Random random(seed);
  Histogram histogram;
  std::vector<Duration> durations;
  for (int i = 0; i < 20'000; ++i) {
    // From a nanosecond to ten minutes, as many in each decade.
    durations.emplace_back(static_cast<std::int64_t>(std::pow(10, random.between(0, 11.7))));
    histogram.add(durations.back());
  }
  for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999, 1.0}) {
    const auto wanted = static_cast<double>(exact(durations, share).count());
    const auto told = static_cast<double>(histogram.at(share).count());
    EXPECT_GE(told, wanted) << share;
    EXPECT_LE(told, wanted * (1 + 1.0 / 1024)) << share;
  }
  EXPECT_EQ(histogram.max(), *std::max_element(durations.begin(), durations.end()));
  EXPECT_EQ(histogram.count(), durations.size());
}

TEST(Histogram, IsExactBelowTwoMicroseconds) {
  for (const std::int64_t value : {0, 1, 17, 1023, 1024, 2047}) {
    Histogram histogram;
    histogram.add(Duration(value));
    histogram.add(std::chrono::seconds(1));
    EXPECT_EQ(histogram.at(0.5).count(), value);
  }
}

TEST(Histogram, ShowsOneSlowAmongThousand) {
  Histogram histogram;
  for (int i = 0; i < 999; ++i) histogram.add(std::chrono::microseconds(100));
  histogram.add(std::chrono::seconds(3));
  EXPECT_LT(histogram.at(0.999), std::chrono::microseconds(101));
  EXPECT_EQ(histogram.at(1), std::chrono::seconds(3));
}

TEST(Histogram, CountsTheLongestAsSuchAndKeepsTheMaximum) {
  Histogram histogram;
  histogram.add(std::chrono::hours(5));
  histogram.add(Duration(-5));
  EXPECT_EQ(histogram.count(), 2U);
  EXPECT_EQ(histogram.at(0.5), Duration::zero());
  EXPECT_EQ(histogram.max(), std::chrono::hours(5));
}

TEST(Histogram, AddsUp) {
  Histogram one;
  Histogram other;
  one.add(Duration(10));
  other.add(Duration(20));
  other.add(Duration(30));
  one.add(other);
  EXPECT_EQ(one.count(), 3U);
  EXPECT_EQ(one.at(0.5).count(), 20);
  EXPECT_EQ(one.max().count(), 30);
}

TEST(Histogram, HasNothingToTellWhenEmpty) {
  EXPECT_EQ(Histogram().count(), 0U);
  EXPECT_EQ(Histogram().at(0.99), Duration::zero());
}

}  // namespace
}  // namespace trc::load
