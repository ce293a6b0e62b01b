#pragma once

#include <atomic>
#include <chrono>

#include "server/work/worker_pool.h"

namespace trc::server {

// Tells whether the workers give turns: how long the oldest waiting turn has waited, and a turn of
// its own that it lets wait among the others. Both are looked at, since the queue knows nothing of
// a worker that takes turns and never ends them, and the beat nothing of a stream that others
// overtake.
class Pulse final : private WorkerPool::Job {
 public:
  // Turns may wait for so long.
  explicit Pulse(std::chrono::seconds longest_wait) : longest_wait_(longest_wait) {}
  // The pool must outlive this object's last beat, and this object the pool's last turn.
  void attach(WorkerPool& pool) { pool_ = &pool; }

  // About once a second: lets the next beat wait for its turn, unless one does.
  void beat();
  [[nodiscard]] double longest_wait_s() const;
  // A turn has waited longer than it may.
  [[nodiscard]] bool stalled() const;
  // No turn was given for so long that none will be: three times as long as one may wait.
  [[nodiscard]] bool dead() const;

 private:
  using Clock = std::chrono::steady_clock;
  void turn() noexcept override { waiting_since_ = Clock::duration::zero(); }
  [[nodiscard]] Clock::duration beat_waits() const;

  const std::chrono::seconds longest_wait_;
  WorkerPool* pool_ = nullptr;
  // Since the epoch of the clock; 0: no beat waits.
  std::atomic<Clock::duration> waiting_since_{Clock::duration::zero()};
};

}  // namespace trc::server
