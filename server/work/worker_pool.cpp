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

// Of this thread. What it has to wait for a core does not count: on a crowded machine short turns
// would give way too.
std::chrono::nanoseconds time_computed() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// When the turn of this thread began, or went on; none in a thread of somebody else.
thread_local std::optional<std::chrono::nanoseconds> began;

// Of the turn of this thread.
thread_local WorkerPool::Group* group_of_turn = nullptr;

// Of this thread alone, on Linux: ten steps below the process, wherever that stands. Where that is
// refused its work takes what it would have taken. A tenth of a core is left where all are wanted:
// a process ends only when its last thread has had its turn, and at the lowest priority that takes
// seconds. For that reason threads that have had no work yet stay as they are.
void leave_the_cores_to_others() {
  constexpr int steps_below = 10;
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + steps_below);
  const sched_param none{};
  (void)sched_setscheduler(0, SCHED_BATCH, &none);
}

// Several turns of batches: giving way costs two changes of thread.
constexpr std::chrono::milliseconds share_of_time{5};

}  // namespace

WorkerPool::WorkerPool(unsigned places, Priority priority)
    : places_(places > 0 ? places : std::max(1U, std::thread::hardware_concurrency())),
      priority_(priority) {
  // No thread is lost for want of a place to note it down.
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
      // Perhaps this one.
      TurnQueue::StandingTurn& next = *queue_.pop_standing().standing;
      next.goes_on = true;
      next.changed.notify_one();
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
      // Whoever has waited for a place must look again.
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
