#include "core/base/pages.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace trc {
namespace {

TEST(Pages, APieceServesTheNextOne) {
  const std::size_t before = PagePiece::count();
  std::byte* memory = nullptr;
  {
    const PagePiece piece;
    memory = piece.memory();
    memory[PagePiece::bytes - 1] = std::byte{7};
    EXPECT_EQ(PagePiece::count(), before + 1);
  }
  EXPECT_EQ(PagePiece::count(), before);
  PagePiece next;
  EXPECT_EQ(next.memory(), memory);
  const PagePiece another = std::move(next);
  EXPECT_EQ(another.memory(), memory);
  EXPECT_EQ(PagePiece::count(), before + 1);
}

TEST(Pages, NoMoreThanSomePiecesAreKept) {
  const auto pieces_mapped = [] {
    std::ifstream statm("/proc/self/statm");
    std::size_t pages = 0;
    statm >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / PagePiece::bytes;
  };
  PagePiece::give_back_spare();
  const std::size_t before = pieces_mapped();
  constexpr std::size_t many = PagePiece::most_spare + 400;
  { const std::vector<PagePiece> pieces(many); }
  const std::size_t kept = pieces_mapped() - before;
  EXPECT_GE(kept, PagePiece::most_spare);
  EXPECT_LT(kept, PagePiece::most_spare + 100);
  PagePiece::give_back_spare();
  EXPECT_LT(pieces_mapped() - before, 100U);
}

TEST(Pages, NoTwoThreadsHaveOnePiece) {
  const std::size_t before = PagePiece::count();
  const auto work = [](unsigned char mine) {
    for (int round = 0; round < 500; ++round) {
      const std::array<PagePiece, 3> pieces;
      for (const PagePiece& piece : pieces) *piece.memory() = std::byte{mine};
      if (round % 100 == 0) PagePiece::give_back_spare();
      for (const PagePiece& piece : pieces) ASSERT_EQ(*piece.memory(), std::byte{mine});
    }
  };
  std::vector<std::thread> threads;
  for (unsigned char id = 1; id <= 4; ++id) threads.emplace_back(work, id);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(PagePiece::count(), before);
}

// A page that was given back to the system reads as zeros.
TEST(Pages, ThoseThatLieWhollyInTheMemoryGoBack) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t bytes = 5 * page;
  const std::unique_ptr<char, decltype(&std::free)> memory(
      static_cast<char*>(std::aligned_alloc(page, bytes)), &std::free);
  char* const begin = memory.get();
  std::fill_n(begin, bytes, 'x');
  give_back_pages(begin + 1, bytes - 2);
  EXPECT_EQ(std::count(begin, begin + page, 'x'), static_cast<std::ptrdiff_t>(page));
  EXPECT_EQ(std::count(begin + page, begin + 4 * page, '\0'),
            static_cast<std::ptrdiff_t>(3 * page));
  EXPECT_EQ(std::count(begin + 4 * page, begin + bytes, 'x'), static_cast<std::ptrdiff_t>(page));
}

TEST(Pages, OfLessThanOneNothingGoesBack) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::unique_ptr<char, decltype(&std::free)> memory(
      static_cast<char*>(std::aligned_alloc(page, 2 * page)), &std::free);
  std::fill_n(memory.get(), 2 * page, 'x');
  give_back_pages(memory.get() + 1, 2 * page - 2);
  give_back_pages(memory.get(), page - 1);
  give_back_pages(memory.get() + 10, 0);
  EXPECT_EQ(std::count(memory.get(), memory.get() + 2 * page, 'x'),
            static_cast<std::ptrdiff_t>(2 * page));
}

}  // namespace
}  // namespace trc
