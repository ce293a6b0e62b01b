#include "server/work/worker_pool.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <deque>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

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
  WorkerPool::Group group;
  std::atomic<int> runs = 0;
  Task task([&] { ++runs; });
  {
    WorkerPool pool(2);
    for (int i = 0; i < 1000; ++i) pool.submit(task, group);
  }
  EXPECT_EQ(runs, 1000);
}

TEST(WorkerPool, HasAThreadPerCoreUnlessTold) {
  EXPECT_GE(WorkerPool(0).thread_count(), 1U);
  EXPECT_EQ(WorkerPool(3).thread_count(), 3U);
}

TEST(WorkerPool, OfLowPriorityLeavesTheCoresToOthers) {
  const auto priority_in = [](WorkerPool::Priority priority) {
    WorkerPool::Group group;
    int found = 0;
    Task task([&] { found = getpriority(PRIO_PROCESS, 0); });
    {
      WorkerPool pool(1, priority);
      pool.submit(task, group);
    }
    return found;
  };
  const int own = getpriority(PRIO_PROCESS, 0);
  EXPECT_EQ(priority_in(WorkerPool::Priority::usual), own);
  EXPECT_EQ(priority_in(WorkerPool::Priority::low), std::min(own + 10, 19));
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), own);
}

TEST(WorkerPool, GivesTurnsInTheOrderOfTheQueue) {
  WorkerPool::Group group;
  std::promise<void> gate;
  std::string order;
  Task first([&] { gate.get_future().wait(); });
  Task a([&] { order += 'a'; });
  Task b([&] { order += 'b'; });
  {
    WorkerPool pool(1);
    pool.submit(first, group);
    pool.submit(a, group);
    pool.submit(b, group);
    pool.submit(a, group);
    EXPECT_GE(pool.queue_depth(), 3U);
    gate.set_value();
  }
  EXPECT_EQ(order, "aba");
}

TEST(WorkerPool, TellsHowLongATurnHasWaited) {
  WorkerPool::Group group;
  std::promise<void> gate;
  Task first([&] { gate.get_future().wait(); });
  Task waiting([] {});
  WorkerPool pool(1);
  EXPECT_EQ(pool.longest_wait(), std::chrono::nanoseconds(0));
  pool.submit(first, group);
  pool.submit(waiting, group);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GE(pool.longest_wait(), std::chrono::milliseconds(50));
  gate.set_value();
  while (pool.queue_depth() > 0) std::this_thread::yield();
  EXPECT_EQ(pool.longest_wait(), std::chrono::nanoseconds(0));
}

TEST(WorkerPool, OneLongStreamDoesNotHoldUpAShortOne) {
  WorkerPool::Group group;
  std::promise<void> gate;
  std::string order;
  WorkerPool* shared = nullptr;
  int left = 100;
  std::function<void()> again;
  Task longest([&] { again(); });
  again = [&] {
    order += 'l';
    if (--left > 0) shared->submit(longest, group);
  };
  Task shortest([&] { order += 's'; });
  Task first([&] { gate.get_future().wait(); });
  {
    WorkerPool pool(1);
    shared = &pool;
    pool.submit(first, group);
    pool.submit(longest, group);
    pool.submit(shortest, group);
    gate.set_value();
    while (pool.queue_depth() > 0) std::this_thread::yield();
  }
  EXPECT_EQ(order.find('s'), 1U);
}

// Turns without an end hold every place, and all others still get theirs.
TEST(WorkerPool, LongTurnsGiveWay) {
  WorkerPool::Group group;
  constexpr unsigned places = 2;
  std::atomic<bool> done = false;
  std::atomic<unsigned> computing = 0;
  std::atomic<unsigned> most_computing = 0;
  WorkerPool* shared = nullptr;
  const auto compute = [&] {
    const unsigned now = ++computing;
    if (now > most_computing) most_computing = now;
    const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(100);
    while (std::chrono::steady_clock::now() < end) {
    }
    --computing;
  };
  const auto endless = [&] {
    while (!done) {
      compute();
      shared->give_way();
    }
  };
  Task first(endless);
  Task second(endless);
  Task third(endless);
  {
    WorkerPool pool(places);
    shared = &pool;
    for (Task* task : {&first, &second, &third}) pool.submit(*task, group);
    for (int round = 0; round < 20; ++round) {
      std::promise<void> served;
      Task small([&] {
        compute();
        served.set_value();
      });
      pool.submit(small, group);
      EXPECT_EQ(served.get_future().wait_for(std::chrono::seconds(10)), std::future_status::ready);
    }
    done = true;
  }
  EXPECT_LE(most_computing, places);
}

TEST(WorkerPool, KeepsItsThreadsForWhenTheyAreNeeded) {
  WorkerPool::Group group;
  std::atomic<int> turns = 0;
  WorkerPool pool(1);
  Task task([&] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
    while (std::chrono::steady_clock::now() < end) pool.give_way();
    ++turns;
  });
  for (int round = 0; round < 5; ++round) {
    pool.submit(task, group);
    pool.submit(task, group);
    while (turns < 2 * (round + 1)) std::this_thread::yield();
  }
  EXPECT_LE(pool.thread_count(), 3U);
}

// The system refuses every thread that is asked for while this lives: its stack would not fit into
// the address space.
class NoThreads {
 public:
  NoThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t hungry;
    pthread_getattr_default_np(&hungry);
    pthread_attr_setstacksize(&hungry, std::size_t{1} << 50U);
    pthread_setattr_default_np(&hungry);
    pthread_attr_destroy(&hungry);
  }
  ~NoThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t before_{};
};

TEST(WorkerPool, SurvivesAThreadThatCannotBeMade) {
  WorkerPool::Group group;
  std::atomic<bool> done = false;
  std::atomic<int> served = 0;
  WorkerPool* shared = nullptr;
  Task endless([&] {
    while (!done) shared->give_way();
  });
  Task small([&] { ++served; });
  const auto is_served = [&](int count) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (served < count && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return served >= count;
  };
  WorkerPool pool(1);
  shared = &pool;
  {
    const NoThreads none;
    pool.submit(endless, group);
    pool.submit(small, group);
    while (pool.threads_missed() == 0) std::this_thread::yield();
    EXPECT_EQ(served, 0);
  }
  // There are threads again: the turn gives way as ever.
  EXPECT_TRUE(is_served(1));
  done = true;
  for (int round = 2; round < 10; ++round) {
    pool.submit(small, group);
    EXPECT_TRUE(is_served(round));
  }
}

TEST(WorkerPool, ThrowsWhenItsThreadsCannotBeMade) {
  const NoThreads none;
  EXPECT_THROW(WorkerPool(2), std::system_error);
}

// A hundred long turns of one group cannot keep another one from its own.
TEST(WorkerPool, GroupsTakeTurnsHoweverManyJobsTheyHave) {
  constexpr int jobs = 150;
  WorkerPool::Group many;
  WorkerPool::Group few;
  std::atomic<bool> done = false;
  WorkerPool* shared = nullptr;
  std::deque<Task> endless;
  for (int i = 0; i < jobs; ++i)
    endless.emplace_back([&] {
      while (!done) shared->give_way();
    });
  WorkerPool pool(2);
  shared = &pool;
  for (Task& task : endless) pool.submit(task, many);
  const auto most = std::chrono::seconds(10);
  for (int round = 0; round < 5; ++round) {
    std::promise<void> served;
    Task small([&] { served.set_value(); });
    pool.submit(small, few);
    EXPECT_EQ(served.get_future().wait_for(most), std::future_status::ready);
  }
  // The threads that many keep are bounded.
  EXPECT_LE(pool.thread_count(), TurnQueue::most_standing_of_one_group + 2 * 2U + 1);
  done = true;
}

TEST(TurnQueue, GroupsComeRoundWhateverWaitsInThem) {
  class Nothing final : public TurnQueue::Job {
   public:
    void turn() noexcept override {}
  };
  std::array<Nothing, 5> jobs;
  TurnQueue::Group many;
  TurnQueue::Group few;
  TurnQueue queue;
  for (std::size_t i = 0; i < 4; ++i) queue.push({.group = &many, .job = &jobs[i]});
  queue.push({.group = &few, .job = &jobs[4]});
  std::vector<TurnQueue::Job*> order;
  while (!queue.empty()) order.push_back(queue.pop().job);
  EXPECT_EQ(order,
            (std::vector<TurnQueue::Job*>{&jobs[0], &jobs[4], &jobs[1], &jobs[2], &jobs[3]}));
}

// Groups of which each has more long turns than may stand still leave room for those to come.
TEST(TurnQueue, NoNumberOfGreedyGroupsKeepsOthersFromBeginning) {
  class Long final : public TurnQueue::Job {
   public:
    void turn() noexcept override {}
  };
  constexpr std::size_t jobs_of_group = 300;
  Long job;
  std::array<TurnQueue::Group, 30> greedy;
  std::list<TurnQueue::StandingTurn> standing;
  TurnQueue queue;
  // Whoever has a turn gives way at once. Whether it was the other one's.
  Long other;
  const auto give_turn = [&] {
    TurnQueue::WaitingTurn next = queue.pop();
    if (next.job == &other) return true;
    if (next.standing == nullptr) next.standing = &standing.emplace_back();
    next.job = nullptr;
    queue.push(next);
    return false;
  };
  for (TurnQueue::Group& group : greedy) {
    for (std::size_t i = 0; i < jobs_of_group; ++i) queue.push({.group = &group, .job = &job});
    for (std::size_t i = 0; i < 10 * jobs_of_group; ++i) give_turn();
  }
  EXPECT_LE(standing.size(), TurnQueue::most_standing);
  TurnQueue::Group modest;
  queue.push({.group = &modest, .job = &other});
  std::size_t before = 0;
  while (!give_turn() && before <= greedy.size()) ++before;
  EXPECT_LE(before, greedy.size());
}

TEST(WorkerPool, AThreadOfSomebodyElseDoesNotGiveWay) {
  WorkerPool::Group group;
  std::promise<void> gate;
  std::atomic<int> runs = 0;
  Task first([&] { gate.get_future().wait(); });
  Task waiting([&] { ++runs; });
  {
    WorkerPool pool(1);
    pool.submit(first, group);
    pool.submit(waiting, group);
    // Computes for longer than a share of time.
    while (std::clock() < CLOCKS_PER_SEC / 50) std::this_thread::yield();
    pool.give_way();
    EXPECT_EQ(pool.thread_count(), 1U);
    EXPECT_EQ(runs, 0);
    gate.set_value();
  }
  EXPECT_EQ(runs, 1);
}

}  // namespace
}  // namespace trc::server
