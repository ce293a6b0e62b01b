#include "server/work/worker_pool.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "server/resources/thread_reserve.h"

namespace trc::server {
namespace {

// CPU time of this thread. Time spent waiting for a core does not count: otherwise short turns
// would give way on a crowded machine.
std::chrono::nanoseconds time_computed() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// When the turn of this thread began or went on; none: the thread is not of the pool.
thread_local std::optional<std::chrono::nanoseconds> began;

// The group of this thread's turn.
thread_local WorkerPool::Group* group_of_turn = nullptr;

// For this thread alone, on Linux: ten steps below the process, whatever its priority. If the
// system refuses, the thread keeps its priority. When all cores are busy, the thread still gets
// about a tenth of one: the process ends only after each thread has run, which would take seconds
// at the lowest priority. For that reason threads without work so far keep their priority.
void leave_the_cores_to_others() {
  constexpr int steps_below = 10;
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + steps_below);
  const sched_param none{};
  (void)sched_setscheduler(0, SCHED_BATCH, &none);
}

// Several turns of batches, because giving way costs two thread switches.
constexpr std::chrono::milliseconds share_of_time{5};

}  // namespace

WorkerPool::WorkerPool(unsigned places, Priority priority)
    : places_(places > 0 ? places : std::max(1U, std::thread::hardware_concurrency())),
      priority_(priority) {
  // Reserved in advance, so that a new thread is never lost because the vector cannot grow.
  threads_.reserve(2 * places_ + TurnQueue::most_standing);
  try {
    for (std::size_t i = 0; i < places_; ++i) threads_.emplace_back([this] { run(); });
  } catch (const std::system_error&) {
    stop();
    throw;
  }
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::submit(Job& job, Group& group) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push({.group = &group, .job = &job, .since = std::chrono::steady_clock::now()});
  }
  changed_.notify_one();
}

bool WorkerPool::have_thread_for_place() {
  if (idle_ >= places_ - taken_ + 1) return true;
  if (threads_.size() == threads_.capacity()) return false;
  try {
    const ThreadReserve::Dispensable this_one;
    threads_.emplace_back([this] { run(); });
    return true;
  } catch (const std::exception&) {
    ++threads_missed_;
    return false;
  }
}

void WorkerPool::give_way() {
  if (!began || time_computed() - *began < share_of_time) return;
  {
    std::unique_lock lock(mutex_);
    if (queue_.empty() || stopping_) return;
    TurnQueue::StandingTurn standing;
    try {
      queue_.push({.group = group_of_turn,
                   .standing = &standing,
                   .since = std::chrono::steady_clock::now()});
    } catch (const std::bad_alloc&) {
      return;
    }
    if (have_thread_for_place()) {
      --taken_;
      changed_.notify_one();
    } else {
      // The next standing turn may be this one, so that there is one.
      if (TurnQueue::StandingTurn* const next = queue_.pop_standing().standing; next != nullptr) {
        next->goes_on = true;
        next->changed.notify_one();
      }
    }
    standing.changed.wait(lock, [&] { return standing.goes_on; });
  }
  began = time_computed();
}

std::size_t WorkerPool::queue_depth() const {
  const std::lock_guard lock(mutex_);
  return queue_.size();
}

std::chrono::nanoseconds WorkerPool::longest_wait() const {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return {};
  return std::chrono::steady_clock::now() - queue_.oldest();
}

std::size_t WorkerPool::thread_count() const {
  const std::lock_guard lock(mutex_);
  return threads_.size();
}

std::uint64_t WorkerPool::threads_missed() const {
  const std::lock_guard lock(mutex_);
  return threads_missed_;
}

void WorkerPool::run() {
  bool has_its_priority = priority_ != Priority::low;
  std::unique_lock lock(mutex_);
  while (true) {
    ++idle_;
    changed_.wait(lock, [this] { return queue_.empty() ? stopping_ : taken_ < places_; });
    --idle_;
    if (queue_.empty()) {
      // Other threads that wait for a place must check again.
      changed_.notify_all();
      return;
    }
    const TurnQueue::WaitingTurn next = queue_.pop();
    ++taken_;
    if (next.standing != nullptr) {
      next.standing->goes_on = true;
      next.standing->changed.notify_one();
      continue;
    }
    lock.unlock();
    if (!std::exchange(has_its_priority, true)) leave_the_cores_to_others();
    began = time_computed();
    group_of_turn = next.group;
    next.job->turn();
    lock.lock();
    --taken_;
  }
}

}  // namespace trc::server
