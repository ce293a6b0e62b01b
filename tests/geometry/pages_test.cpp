#include "core/base/pages.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>

namespace trc {
namespace {

// What was in a page that went back reads as zeros.
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
