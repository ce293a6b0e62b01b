#include "server/rpc/meter.h"

#include <gtest/gtest.h>

namespace trc::server {
namespace {

Summary so_far(std::uint64_t blocks_in, std::uint64_t blocks_out) {
  Summary summary;
  summary.blocks_in = blocks_in;
  summary.blocks_out = blocks_out;
  return summary;
}

TEST(Meter, CountsWhatHasNotComeOut) {
  MemoryBudget budget(1'000'000'000);
  Meter meter(budget, Limits{});
  EXPECT_TRUE(meter.holds(so_far(1000, 0), 0));
  const std::uint64_t of_1000 = budget.used_bytes();
  EXPECT_GT(of_1000, 1000 * sizeof(MotionBlock));
  EXPECT_TRUE(meter.holds(so_far(2000, 0), 0));
  EXPECT_EQ(budget.used_bytes(), 2 * of_1000);
  // All of it is let go, and the next request is taken.
  EXPECT_TRUE(meter.holds(so_far(2100, 1500), 0));
  EXPECT_EQ(budget.used_bytes(), of_1000 / 10);
}

TEST(Meter, DroppedAndInsertedBlocksDoNotAddUp) {
  MemoryBudget budget(1'000'000'000);
  Meter meter(budget, Limits{});
  for (std::uint64_t i = 1; i < 1000; ++i) ASSERT_TRUE(meter.holds(so_far(i * 100, i), 0));
  const std::uint64_t dropping = budget.used_bytes();
  for (std::uint64_t i = 1; i < 1000; ++i)
    ASSERT_TRUE(meter.holds(so_far((1000 + i) * 100, i * 300), 0));
  EXPECT_EQ(budget.used_bytes(), dropping);
}

TEST(Meter, AWindowCountsAsFull) {
  MemoryBudget budget(1'000'000'000);
  Meter window(budget, Limits{.look_ahead_blocks = 5000});
  EXPECT_TRUE(window.holds(so_far(10'000, 5000), 0));
  EXPECT_TRUE(window.holds(so_far(10'001, 5001), 0));
  const std::uint64_t full = budget.used_bytes();
  Meter whole(budget, Limits{});
  EXPECT_TRUE(whole.holds(so_far(5000, 0), 0));
  EXPECT_EQ(budget.used_bytes(), 2 * full);
}

TEST(Meter, SaysWhenTheBudgetIsPassed) {
  MemoryBudget budget(1'000'000);
  Meter meter(budget, Limits{});
  EXPECT_TRUE(meter.holds(so_far(10, 0), 0));
  EXPECT_FALSE(meter.holds(so_far(10, 0), 1'000'000));
  EXPECT_FALSE(meter.holds(so_far(1'000'000, 0), 0));
  EXPECT_TRUE(meter.holds(so_far(1'000'000, 1), 0));
}

}  // namespace
}  // namespace trc::server
