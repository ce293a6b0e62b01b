#include "server/resources/thread_reserve.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>

namespace trc::server {
namespace {

std::atomic<int> works = 0;

void* work(void* argument) {
  ++works;
  return argument;
}

bool give_and_join() {
  pthread_t thread{};
  int word = 0;
  void* answer = nullptr;
  if (!ThreadReserve::give(&thread, nullptr, work, &word)) return false;
  return pthread_join(thread, &answer) == 0 && answer == &word;
}

int no_thread_left(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) { return EAGAIN; }

TEST(ThreadReserve, GivesAsManyAsThereAreAndRemembersWhoWentWithout) {
  EXPECT_FALSE(give_and_join());
  EXPECT_FALSE(ThreadReserve::failed()) << "nothing is promised before there is a reserve";
  ASSERT_TRUE(ThreadReserve::install(5));
  ASSERT_TRUE(ThreadReserve::install(2));
  EXPECT_TRUE(give_and_join());
  EXPECT_TRUE(ThreadReserve::refill());
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(give_and_join());
  EXPECT_EQ(works, 3);
  {
    const ThreadReserve::Dispensable this_one;
    EXPECT_FALSE(give_and_join());
  }
  EXPECT_FALSE(ThreadReserve::failed());
  EXPECT_FALSE(ThreadReserve::install(2, no_thread_left));
  EXPECT_FALSE(give_and_join());
  EXPECT_TRUE(ThreadReserve::failed());
}

}  // namespace
}  // namespace trc::server
