#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace trc::server {

// The threads that compute. gRPC runs all reactions of the process on a few threads of its own, so
// a reaction that computed would hold up every other stream and the health check; it submits a job
// here instead.
//
// Jobs wait in one queue and get one turn each: a stream with much to do goes to the back after
// every batch, so that streams share the threads evenly. A stream has at most one job in the queue,
// so the limit of streams bounds the queue too. A batch that ends a selection of millions of blocks
// makes a turn of seconds, which gives way in between.
class WorkerPool {
 public:
  class Job {
   public:
    // One batch of work. May end in the destruction of the job; must not throw.
    virtual void turn() noexcept = 0;

   protected:
    ~Job() = default;
  };

  // How many turns go on at once: 0 stands for one per core. Throws std::system_error when the
  // threads cannot be made.
  explicit WorkerPool(unsigned places);
  // Gives the waiting jobs their turn, then joins the threads.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // The job must live until its turn is over.
  void submit(Job& job);

  // To be called again and again in a turn that may take long. Once it has computed for
  // some milliseconds and others wait, the turn goes to the back of the queue: it stands still, and
  // another thread takes its place; when none can be made for it, the turn keeps its place. Does
  // nothing in a thread that is not of the pool.
  void give_way();

  [[nodiscard]] std::size_t queue_depth() const;
  // How long the turn that waits longest has waited; 0 when none waits.
  [[nodiscard]] std::chrono::nanoseconds longest_wait() const;
  // The threads there are: one for each place, and one for each turn that has ever stood still at
  // the same time as others.
  [[nodiscard]] std::size_t thread_count() const;
  // How often a turn could not give way because the system gave no thread.
  [[nodiscard]] std::uint64_t threads_missed() const;

 private:
  // A turn that stands still.
  struct Standing {
    std::condition_variable changed{};
    bool goes_on = false;
  };
  // One of the two.
  struct Waiting {
    Job* job = nullptr;
    Standing* standing = nullptr;
    std::chrono::steady_clock::time_point since{};
  };
  // A turn beyond so many does not stand still, but keeps its place: threads are not for nothing.
  static constexpr std::size_t most_standing = 64;

  void run();
  void stop();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> queue_;
  const std::size_t places_;
  std::size_t taken_ = 0;     // places
  std::size_t idle_ = 0;      // threads
  std::size_t standing_ = 0;  // turns
  std::uint64_t threads_missed_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace trc::server
