#include "server/http/view/view_queue.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace trc::server::http {
namespace {

using Path = std::vector<CompensatedBlock>;

Path path_of(std::size_t blocks, std::uint64_t first) {
  Path path(blocks);
  for (std::size_t i = 0; i < blocks; ++i) path[i].source.index = first + i;
  return path;
}

TEST(ViewQueue, SendsOneTakerUntilNothingWaits) {
  ViewQueue queue;
  EXPECT_EQ(queue.put(path_of(1, 0)), ViewQueue::Taker::wanted);
  EXPECT_EQ(queue.put(path_of(1, 1)), ViewQueue::Taker::comes);
  EXPECT_TRUE(queue.take());
  EXPECT_EQ(queue.put(path_of(1, 2)), ViewQueue::Taker::comes);
  EXPECT_TRUE(queue.take());
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.take());
  EXPECT_EQ(queue.put(path_of(1, 3)), ViewQueue::Taker::wanted);
}

TEST(ViewQueue, KeepsTheOrderOfContourAndPath) {
  ViewQueue queue;
  constexpr std::uint64_t pieces = 20'000;
  std::thread giver([&] {
    for (std::uint64_t i = 0; i < pieces; ++i) {
      if (i % 2 == 0) {
        std::vector<Block> contour = queue.spare<Block>();
        EXPECT_TRUE(contour.empty());
        contour.emplace_back(MotionBlock{.source = {.index = i}});
        (void)queue.put(std::move(contour));
      } else {
        Path path = queue.spare<CompensatedBlock>();
        EXPECT_TRUE(path.empty());
        path.push_back({.source = {.index = i}});
        (void)queue.put(std::move(path));
      }
    }
  });
  std::uint64_t taken = 0;
  while (taken < pieces) {
    std::optional<ViewQueue::Piece> piece = queue.take();
    if (!piece) continue;
    if (const auto* path = std::get_if<Path>(&*piece))
      EXPECT_EQ(path->front().source.index, taken);
    else
      EXPECT_EQ(index_of(std::get<std::vector<Block>>(*piece).front()), taken);
    queue.give_back(std::move(*piece));
    ++taken;
  }
  giver.join();
}

// Memory stays bounded: whoever gives takes then.
TEST(ViewQueue, IsFullWithSomeTensOfThousandsOfBlocks) {
  ViewQueue queue;
  (void)queue.put(path_of(30'000, 0));
  EXPECT_FALSE(queue.is_full());
  (void)queue.put(path_of(10'000, 0));
  EXPECT_TRUE(queue.is_full());
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.is_full());
}

TEST(ViewQueue, LendsTheMemoryOfSmallPiecesAgain) {
  ViewQueue queue;
  (void)queue.put(path_of(100, 0));
  queue.give_back(*queue.take());
  EXPECT_TRUE(queue.spare<Block>().empty());
  EXPECT_GE(queue.spare<CompensatedBlock>().capacity(), 100U);
  EXPECT_EQ(queue.spare<CompensatedBlock>().capacity(), 0U);
  (void)queue.put(path_of(100'000, 0));
  queue.give_back(*queue.take());
  EXPECT_EQ(queue.spare<CompensatedBlock>().capacity(), 0U);
}

}  // namespace
}  // namespace trc::server::http
