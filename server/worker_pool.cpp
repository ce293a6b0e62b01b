#include "server/worker_pool.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <new>
#include <optional>
#include <system_error>

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

// Several turns of batches: giving way costs two changes of thread.
constexpr std::chrono::milliseconds share_of_time{5};

}  // namespace

WorkerPool::WorkerPool(unsigned places)
    : places_(places > 0 ? places : std::max(1U, std::thread::hardware_concurrency())) {
  // No thread is lost for want of a place to note it down.
  threads_.reserve(places_ + most_standing);
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

void WorkerPool::submit(Job& job) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back({.job = &job, .since = std::chrono::steady_clock::now()});
  }
  changed_.notify_one();
}

void WorkerPool::give_way() {
  if (!began || time_computed() - *began < share_of_time) return;
  {
    std::unique_lock lock(mutex_);
    if (queue_.empty() || stopping_ || standing_ == most_standing) return;
    Standing standing;
    // What may fail comes first: a turn that cannot be replaced goes on in its place.
    try {
      if (idle_ < places_ - taken_ + 1) threads_.emplace_back([this] { run(); });
      queue_.push_back({.standing = &standing, .since = std::chrono::steady_clock::now()});
    } catch (const std::system_error&) {
      ++threads_missed_;
      began = time_computed();
      return;
    } catch (const std::bad_alloc&) {
      return;
    }
    --taken_;
    ++standing_;
    changed_.notify_one();
    standing.changed.wait(lock, [&] { return standing.goes_on; });
    --standing_;
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
  return std::chrono::steady_clock::now() - queue_.front().since;
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
    const Waiting next = queue_.front();
    queue_.pop_front();
    ++taken_;
    if (next.standing != nullptr) {
      next.standing->goes_on = true;
      next.standing->changed.notify_one();
      continue;
    }
    lock.unlock();
    began = time_computed();
    next.job->turn();
    lock.lock();
    --taken_;
  }
}

}  // namespace trc::server
