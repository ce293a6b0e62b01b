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

// A cgroup that may have so much memory, of version 2 or 1; what passes it is killed. Root alone
// may make one.
class MemoryGroup {
 public:
  explicit MemoryGroup(std::uint64_t limit_bytes) {
    const std::string name = "/trc-test-" + std::to_string(getpid());
    for (const auto& [hierarchy, limit, peak] :
         {Version{"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.max_usage_in_bytes"},
          Version{"/sys/fs/cgroup", "memory.max", "memory.peak"}}) {
      const std::string path = hierarchy + name;
      if (mkdir(path.c_str(), 0755) != 0) continue;
      path_ = path;
      peak_ = path + "/" + peak;
      std::ofstream(path + "/" + limit) << limit_bytes;
      std::uint64_t set = 0;
      if (std::ifstream(path + "/" + limit) >> set && set == limit_bytes) return;
      rmdir(path.c_str());
      path_.clear();
    }
  }
  ~MemoryGroup() {
    // What was in it may just be ending.
    for (int i = 0; !path_.empty() && rmdir(path_.c_str()) != 0 && i < 100; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  MemoryGroup(const MemoryGroup&) = delete;
  MemoryGroup& operator=(const MemoryGroup&) = delete;

  [[nodiscard]] bool exists() const { return !path_.empty(); }
  // Starts what stands behind it inside; outside where there is no group.
  [[nodiscard]] std::vector<std::string> launcher() const {
    if (!exists()) return {};
    return {"/bin/sh", "-c", "echo $$ >" + path_ + "/cgroup.procs && exec \"$0\" \"$@\""};
  }
  // The most it has used; 0 where that is not told.
  [[nodiscard]] std::uint64_t peak_bytes() const {
    std::uint64_t peak = 0;
    std::ifstream(peak_) >> peak;
    return peak;
  }

 private:
  struct Version {
    std::string hierarchy;
    std::string limit;
    std::string peak;
  };
  std::string path_{};
  std::string peak_{};
};

}  // namespace trc::faults
