#include "proto/wire/message_size.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "proto/wire/compensated_block.h"
#include "tests/wire/samples.h"

namespace trc::wire {
namespace {

// Tags and lengths of the columns themselves.
constexpr std::size_t frame = 160;

std::size_t told(std::span<const CompensatedBlock> blocks, Layout layout) {
  std::size_t bytes = 0;
  for (const CompensatedBlock& block : blocks) bytes += most_bytes(block, layout);
  return bytes;
}

template <class Message>
std::size_t sent(std::span<const CompensatedBlock> blocks) {
  Message message;
  to_proto(blocks, 1'000'000'000, message);
  return message.ByteSizeLong();
}

void expect_enough(std::span<const CompensatedBlock> blocks) {
  EXPECT_LE(sent<v1::CompensatedBatch>(blocks), frame + told(blocks, Layout::blocks));
  EXPECT_LE(sent<v1::CompensatedColumns>(blocks), frame + told(blocks, Layout::columns));
}

// One alone, and many of it: a message of them must not outgrow what was told.
TEST(MessageSize, IsEnoughForEveryBlock) {
  for (CompensatedBlock block : every_compensated_block()) {
    for (const std::int64_t number : {Source::no_number, std::int64_t{1} << 62}) {
      block.source = {.index = 0xffffffff, .number = number, .line = 0xffffffff};
      expect_enough({&block, 1});
      expect_enough(std::vector<CompensatedBlock>(100, block));
    }
  }
}

TEST(MessageSize, IsEnoughForRandomPaths) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_enough(random_compensated_blocks(seed, 300));
  }
}

// What is told in vain makes messages small.
TEST(MessageSize, IsNotFarTooMuch) {
  const std::vector<CompensatedBlock> blocks = random_compensated_blocks(1, 300);
  EXPECT_LE(told(blocks, Layout::blocks), 2 * sent<v1::CompensatedBatch>(blocks));
  EXPECT_LE(told(blocks, Layout::columns), 2 * sent<v1::CompensatedColumns>(blocks));
}

}  // namespace
}  // namespace trc::wire
