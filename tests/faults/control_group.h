#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace trc::faults {

// A cgroup of version 2 or 1 with a limit of one kind. Root alone may make one.
class ControlGroup {
 public:
  // Where the limit is, and the most that was used, in a hierarchy of one version.
  struct Version {
    std::string hierarchy;
    std::string limit;
    std::string peak;
  };

  ControlGroup(const std::vector<Version>& versions, std::uint64_t limit) {
    const std::string name = "/trc-test-" + std::to_string(getpid());
    for (const Version& version : versions) {
      const std::string path = version.hierarchy + name;
      if (mkdir(path.c_str(), 0755) != 0) continue;
      path_ = path;
      limit_ = path + "/" + version.limit;
      peak_ = path + "/" + version.peak;
      if (set_limit(limit)) return;
      rmdir(path.c_str());
      path_.clear();
    }
  }
  ~ControlGroup() {
    // What was in it may just be ending.
    for (int i = 0; exists() && rmdir(path_.c_str()) != 0 && i < 100; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;

  [[nodiscard]] bool exists() const { return !path_.empty(); }
  // False where there is no such limit.
  bool set_limit(std::uint64_t limit) const {
    std::ofstream(limit_) << limit;
    std::uint64_t set = 0;
    return std::ifstream(limit_) >> set && set == limit;
  }
  // Starts what stands after it inside; outside where there is no group.
  [[nodiscard]] std::vector<std::string> launcher() const {
    if (!exists()) return {};
    return {"/bin/sh", "-c", "echo $$ >" + path_ + "/cgroup.procs && exec \"$0\" \"$@\""};
  }
  // The most it has used; 0 where that is not told.
  [[nodiscard]] std::uint64_t peak() const {
    std::uint64_t peak = 0;
    std::ifstream(peak_) >> peak;
    return peak;
  }

 private:
  std::string path_{};
  std::string limit_{};
  std::string peak_{};
};

// So many bytes; what passes them is killed.
class MemoryGroup : public ControlGroup {
 public:
  explicit MemoryGroup(std::uint64_t limit_bytes)
      : ControlGroup(
            {{"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.max_usage_in_bytes"},
             {"/sys/fs/cgroup", "memory.max", "memory.peak"}},
            limit_bytes) {}
};

// So many threads; more are not made.
class ThreadGroup : public ControlGroup {
 public:
  explicit ThreadGroup(std::uint64_t limit)
      : ControlGroup({{"/sys/fs/cgroup/pids", "pids.max", "pids.peak"},
                      {"/sys/fs/cgroup", "pids.max", "pids.peak"}},
                     limit) {}
};

}  // namespace trc::faults
