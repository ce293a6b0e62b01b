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

TEST(Meter, TellsWhetherSomethingCameOut) {
  Meter meter(Limits{});
  EXPECT_FALSE(meter.note(so_far(1000, 0)));
  EXPECT_TRUE(meter.note(so_far(2000, 500)));
  EXPECT_FALSE(meter.note(so_far(3000, 500)));
}

TEST(Meter, CountsWhatHasNotComeOut) {
  Meter meter(Limits{});
  EXPECT_TRUE(meter.holds_few());
  meter.note(so_far(1000, 0));
  EXPECT_FALSE(meter.holds_few());
  // All of it is let go, and the next request is taken.
  meter.note(so_far(1100, 900));
  EXPECT_TRUE(meter.holds_few());
}

TEST(Meter, DroppedAndInsertedBlocksDoNotAddUp) {
  Meter meter(Limits{});
  for (std::uint64_t i = 1; i < 1000; ++i) {
    meter.note(so_far(i * 100, i));
    ASSERT_TRUE(meter.holds_few()) << i;
  }
  for (std::uint64_t i = 1; i < 1000; ++i) {
    meter.note(so_far((999 + i) * 100, 1000 + i * 300));
    ASSERT_TRUE(meter.holds_few()) << i;
  }
}

TEST(Meter, AWindowCountsAsFull) {
  Meter meter(Limits{.look_ahead_blocks = 5000});
  meter.note(so_far(10'000, 5000));
  meter.note(so_far(10'001, 5001));
  EXPECT_FALSE(meter.holds_few());
}

}  // namespace
}  // namespace trc::server
