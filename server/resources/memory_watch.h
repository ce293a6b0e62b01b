#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace trc::server {

// The memory this process may have: the smallest limit of its cgroups, of version 2 or 1, else what
// the machine has.
[[nodiscard]] std::uint64_t memory_limit_bytes();
// The limit by these files, in place of /proc/self/cgroup, /sys/fs/cgroup and /proc/meminfo.
[[nodiscard]] std::uint64_t memory_limit_bytes(const std::string& groups_file,
                                               const std::string& hierarchy,
                                               const std::string& machine_file);

// The resident memory of this process, without files.
[[nodiscard]] std::uint64_t resident_bytes();

// Watches the process as a whole, while the budget of the streams sees only the memory it counts: a
// process above the limit of its container is killed without a message.
class MemoryWatch {
 public:
  enum class State {
    ample,
    scarce,    // above 85 % of the limit: nothing new is begun
    critical,  // above 95 %, or the reserve of the heap is used up: the largest stream has to go
  };
  struct Settings {
    std::uint64_t limit_bytes = 0;  // 0: none
    // Called in the thread of the watch, again and again while the state is critical.
    std::function<void()> end_largest{};
    // Whether the stream that was told to end last still holds memory.
    std::function<bool()> is_one_ending = [] { return false; };
    // What streams hold just now.
    std::function<std::uint64_t()> counted_bytes{};
    std::function<std::uint64_t()> resident_bytes{};
  };

  explicit MemoryWatch(Settings settings);
  ~MemoryWatch();
  MemoryWatch(const MemoryWatch&) = delete;
  MemoryWatch& operator=(const MemoryWatch&) = delete;

  [[nodiscard]] State state() const { return state_; }
  // To be called when much memory has been freed.
  void give_back_soon() { gives_back_soon_ = true; }
  [[nodiscard]] std::uint64_t limit_bytes() const { return settings_.limit_bytes; }

 private:
  void run();
  void look();
  // Freed memory stays with the heap, and spare pages with this process, until this gives them
  // back. Does nothing for less than `worth`.
  void give_back(std::uint64_t resident, std::uint64_t worth);

  const Settings settings_;
  std::atomic<State> state_ = State::ample;
  std::atomic<bool> gives_back_soon_ = false;
  bool has_room_ = true;
  std::uint64_t left_ = 0;  // resident, after what could be given back was
  unsigned rounds_until_give_back_ = 0;
  unsigned rounds_since_trimmed_ = 0;
  unsigned rounds_of_one_ending_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace trc::server
