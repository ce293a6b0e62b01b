#pragma once

#include <condition_variable>
#include <cstddef>
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
// so the limit of streams bounds the queue too.
class WorkerPool {
 public:
  class Job {
   public:
    // One batch of work. May end in the destruction of the job; must not throw.
    virtual void turn() noexcept = 0;

   protected:
    ~Job() = default;
  };

  // Threads: 0 stands for one per core.
  explicit WorkerPool(unsigned threads);
  // Gives the waiting jobs their turn, then joins the threads.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // The job must live until its turn is over.
  void submit(Job& job);

  [[nodiscard]] std::size_t queue_depth() const;
  [[nodiscard]] std::size_t thread_count() const { return threads_.size(); }

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable submitted_;
  std::deque<Job*> queue_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace trc::server
