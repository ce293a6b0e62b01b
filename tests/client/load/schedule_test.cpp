#include "client/load/schedule.h"

#include <gtest/gtest.h>

namespace trc::load {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

std::uint64_t begun_until(const Schedule& schedule, nanoseconds until) {
  std::uint64_t count = 0;
  while (schedule.begin_of(count) < until) ++count;
  return count;
}

TEST(Schedule, KeepsItsRate) {
  const Schedule schedule(200, {});
  EXPECT_EQ(schedule.begin_of(0), nanoseconds(0));
  EXPECT_EQ(schedule.begin_of(1), milliseconds(5));
  EXPECT_EQ(schedule.begin_of(1000), seconds(5));
}

TEST(Schedule, GrowsEvenlyDuringTheRamp) {
  const Schedule schedule(100, seconds(4));
  // The mean rate is a quarter in the first half of the ramp, three quarters in the second one.
  EXPECT_NEAR(static_cast<double>(begun_until(schedule, seconds(2))), 50, 1);
  EXPECT_NEAR(static_cast<double>(begun_until(schedule, seconds(4))), 200, 1);
  EXPECT_NEAR(static_cast<double>(begun_until(schedule, seconds(5))), 300, 1);
}

TEST(Schedule, NeverRunsBackwards) {
  const Schedule schedule(777, milliseconds(333));
  for (std::uint64_t i = 0; i < 2000; ++i)
    EXPECT_LT(schedule.begin_of(i), schedule.begin_of(i + 1)) << i;
}

TEST(Sampling, TakesTheShareOfAnyRowOfStreams) {
  for (const double share : {0.02, 0.25, 1.0 / 3, 0.9}) {
    SCOPED_TRACE(share);
    for (const std::uint64_t begin : {0U, 1U, 77U, 1000U}) {
      int taken = 0;
      for (std::uint64_t i = begin; i < begin + 600; ++i) taken += is_sampled(i, share) ? 1 : 0;
      EXPECT_NEAR(taken, 600 * share, 1) << begin;
    }
    EXPECT_TRUE(is_sampled(0, share));
  }
}

TEST(Sampling, TakesAllOrNone) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_TRUE(is_sampled(i, 1));
    EXPECT_FALSE(is_sampled(i, 0));
  }
}

}  // namespace
}  // namespace trc::load
