#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace trc::load {

// The resources that a process of this machine has used so far.
struct ProcessUse {
  double cpu_s = 0;     // of all its threads, those that have ended too
  double system_s = 0;  // of it in the kernel, to 10 ms
  double resident_mib = 0;
};

// Empty when there is no such process, or it may not be looked at.
[[nodiscard]] std::optional<ProcessUse> use_of(pid_t process);

// The process that listens at HOST:PORT or unix:/path, if it runs on this machine, in this network
// namespace, and may be looked at.
[[nodiscard]] std::optional<pid_t> listening_process(const std::string& address);

}  // namespace trc::load
