#include "core/base/numbered_queue.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>

namespace trc {
namespace {

TEST(NumberedQueue, ElementsKeepTheirNumberAndTheirPlace) {
  NumberedQueue<std::size_t> queue(1000);
  for (std::size_t number = 1000; number < 3000; ++number) queue.push_back(7 * number);
  const std::size_t* place = &queue[2500];
  queue.drop_before(2400);
  for (std::size_t number = 3000; number < 5000; ++number) queue.push_back(7 * number);
  EXPECT_EQ(queue.begin(), 2400U);
  EXPECT_EQ(queue.end(), 5000U);
  EXPECT_EQ(&queue[2500], place);
  for (std::size_t number = 2400; number < 5000; ++number) ASSERT_EQ(queue[number], 7 * number);
}

TEST(NumberedQueue, GoesOnWhereItWasCutOff) {
  NumberedQueue<int> queue;
  for (int i = 0; i < 600; ++i) queue.push_back(i);
  queue.drop_before(500);
  queue.truncate(550);
  EXPECT_EQ(queue.end(), 550U);
  EXPECT_EQ(queue.push_back(-1), -1);
  EXPECT_EQ(queue[550], -1);
  EXPECT_EQ(queue[549], 549);
  queue.truncate(100);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.end(), 100U);
  queue.push_back(8);
  EXPECT_EQ(queue[100], 8);
}

TEST(NumberedQueue, IsReadFromAnyElementOn) {
  NumberedQueue<std::size_t> queue(100);
  for (std::size_t number = 100; number < 2000; ++number) queue.push_back(7 * number);
  queue.drop_before(700);
  for (const std::size_t first : {700U, 767U, 768U, 769U, 1999U}) {
    auto elements = queue.from(first);
    for (std::size_t number = first; number < 2000; ++number)
      ASSERT_EQ(&elements.next(), &queue[number]);
  }
}

TEST(NumberedQueue, HasALastElementWhereverItWasCutOff) {
  NumberedQueue<std::size_t> queue;
  for (std::size_t end : {770U, 769U, 768U, 767U, 512U}) {
    while (queue.end() < 1000) queue.push_back(3 * queue.end());
    queue.truncate(end);
    EXPECT_EQ(&queue.back(), &queue[end - 1]);
    queue.drop_before(end / 2);
    EXPECT_EQ(queue.back(), 3 * (end - 1));
  }
}

TEST(NumberedQueue, LetsGoOfWhatItsElementsHold) {
  NumberedQueue<std::shared_ptr<int>> queue;
  const auto shared = std::make_shared<int>(1);
  for (int i = 0; i < 10; ++i) queue.push_back(shared);
  queue.drop_before(4);
  EXPECT_EQ(shared.use_count(), 7);
  queue.truncate(6);
  EXPECT_EQ(shared.use_count(), 3);
}

// A long queue allocates and frees its memory in larger steps.
TEST(NumberedQueue, ElementsKeepTheirNumberAndTheirPlaceInALongOne) {
  NumberedQueue<std::size_t> queue(100);
  for (std::size_t number = 100; number < 100'000; ++number) queue.push_back(7 * number);
  const std::size_t* place = &queue[99'000];
  for (std::size_t begin = 300; begin <= 90'000; begin += 300) {
    queue.drop_before(begin);
    ASSERT_EQ(queue[begin], 7 * begin);
  }
  queue.truncate(99'500);
  for (std::size_t number = 99'500; number < 200'000; ++number) queue.push_back(7 * number);
  EXPECT_EQ(&queue[99'000], place);
  for (std::size_t number = 90'000; number < 200'000; ++number)
    ASSERT_EQ(queue[number], 7 * number);
  queue.drop_before(200'000);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.push_back(8), 8U);
  EXPECT_EQ(queue[200'000], 8U);
}

TEST(NumberedQueue, DroppedAndCutOffAtOnceAtEveryLength) {
  for (std::size_t most = 1; most < 1'500; most += 37) {
    NumberedQueue<std::size_t> queue(100);
    for (std::size_t round = 0; round < 40; ++round) {
      while (queue.size() < most) queue.push_back(3 * queue.end());
      queue.truncate(queue.end() - most / 3);
      queue.drop_before(queue.begin() + most / 4);
      for (std::size_t number = queue.begin(); number < queue.end(); ++number)
        ASSERT_EQ(queue[number], 3 * number) << most << " elements, round " << round;
      if (!queue.empty()) {
        ASSERT_EQ(queue.back(), 3 * (queue.end() - 1));
      }
    }
  }
}

TEST(NumberedQueue, ClearedLetsGoOfItsElementsAndCountsAnew) {
  NumberedQueue<std::shared_ptr<int>, 16> queue;
  const auto shared = std::make_shared<int>(1);
  for (const int count : {1, 16, 17, 5'000, 3}) {
    for (int i = 0; i < count; ++i) queue.push_back(shared);
    queue.drop_before(static_cast<std::size_t>(count / 3));
    queue.clear(100);
    EXPECT_EQ(shared.use_count(), 1);
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.end(), 100U);
    queue.push_back(shared);
    EXPECT_EQ(queue[100], shared);
    EXPECT_EQ(queue.back(), shared);
    queue.clear();
    EXPECT_EQ(queue.begin(), 0U);
  }
}

TEST(NumberedQueue, EmptiedAndFilledAgainManyTimes) {
  NumberedQueue<std::size_t> queue;
  for (std::size_t number = 0; number < 10'000; ++number) {
    queue.push_back(number);
    if (number % 3 == 2) queue.drop_before(number + 1);
    if (number % 3 != 2) {
      ASSERT_EQ(queue[number], number);
    }
  }
  EXPECT_EQ(queue.size(), 1U);
}

}  // namespace
}  // namespace trc
