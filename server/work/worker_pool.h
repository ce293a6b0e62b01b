#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "server/work/turn_queue.h"

namespace trc::server {

// The threads that compute. gRPC runs all reactions of the process on a few threads of its own, so
// a reaction that computed for long would hold up every other stream and the health check; it
// submits a job here instead.
//
// Jobs wait in one queue and get one turn each: a stream with much to do goes to the back after
// every batch, so that streams share the threads evenly, and the groups of streams do: those of one
// peer. A stream has at most one job in the queue, so the limit of streams bounds the queue too. A
// batch that ends a selection of millions of blocks makes a turn of seconds, which gives way in
// between.
class WorkerPool {
 public:
  using Group = TurnQueue::Group;
  using Job = TurnQueue::Job;

  enum class Priority {
    usual,
    low,  // leaves the cores to others: a tenth is left where somebody wants them all
  };
  // How many turns go on at once: 0 stands for one per core. Throws std::system_error when the
  // threads cannot be made.
  explicit WorkerPool(unsigned places, Priority priority = Priority::usual);
  // Gives the waiting jobs their turn, then joins the threads.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // The job must live until its turn is over, and its group as long.
  void submit(Job& job, Group& group);
  // For jobs that name no group: they share one.
  void submit(Job& job) { submit(job, others_); }

  // To be called again and again in a turn that may take long. Once it has computed for
  // some milliseconds and others wait, the turn goes to the back of the queue: it stands still, and
  // another thread takes its place; when none can be made for it, another turn that stands still
  // goes on, or this one. Does nothing in a thread that is of no pool; not to be called in one of
  // another pool.
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
  void run();
  void stop();
  // Under the lock; false: no thread can be had.
  bool have_thread_for_place();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Group others_;
  TurnQueue queue_;
  const std::size_t places_;
  const Priority priority_;
  std::size_t taken_ = 0;  // places
  std::size_t idle_ = 0;   // threads
  std::uint64_t threads_missed_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace trc::server
