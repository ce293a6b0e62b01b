#include "server/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <mutex>
#include <string>

namespace trc::server {
namespace {

class Task final : public WorkerPool::Job {
 public:
  explicit Task(std::function<void()> work) : work_(std::move(work)) {}
  void turn() noexcept override { work_(); }

 private:
  std::function<void()> work_;
};

TEST(WorkerPool, RunsEveryJobBeforeItEnds) {
  std::atomic<int> runs = 0;
  Task task([&] { ++runs; });
  {
    WorkerPool pool(2);
    for (int i = 0; i < 1000; ++i) pool.submit(task);
  }
  EXPECT_EQ(runs, 1000);
}

TEST(WorkerPool, HasAThreadPerCoreUnlessTold) {
  EXPECT_GE(WorkerPool(0).thread_count(), 1U);
  EXPECT_EQ(WorkerPool(3).thread_count(), 3U);
}

TEST(WorkerPool, GivesTurnsInTheOrderOfTheQueue) {
  std::promise<void> gate;
  std::string order;
  Task first([&] { gate.get_future().wait(); });
  Task a([&] { order += 'a'; });
  Task b([&] { order += 'b'; });
  {
    WorkerPool pool(1);
    pool.submit(first);
    pool.submit(a);
    pool.submit(b);
    pool.submit(a);
    EXPECT_GE(pool.queue_depth(), 3U);
    gate.set_value();
  }
  EXPECT_EQ(order, "aba");
}

TEST(WorkerPool, OneLongStreamDoesNotHoldUpAShortOne) {
  std::promise<void> gate;
  std::string order;
  WorkerPool* shared = nullptr;
  int left = 100;
  std::function<void()> again;
  Task longest([&] { again(); });
  again = [&] {
    order += 'l';
    if (--left > 0) shared->submit(longest);
  };
  Task shortest([&] { order += 's'; });
  Task first([&] { gate.get_future().wait(); });
  {
    WorkerPool pool(1);
    shared = &pool;
    pool.submit(first);
    pool.submit(longest);
    pool.submit(shortest);
    gate.set_value();
    while (pool.queue_depth() > 0) std::this_thread::yield();
  }
  EXPECT_EQ(order.find('s'), 1U);
}

}  // namespace
}  // namespace trc::server
