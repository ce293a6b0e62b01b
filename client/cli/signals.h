#pragma once

#include <chrono>
#include <csignal>
#include <vector>

namespace trc::cli {

// As long as there is one, and there may be one at a time, ends of child processes and the wish to
// end (SIGINT, SIGTERM, SIGHUP) are told here in place of what they do else, whichever thread they
// reach. What is ignored stays so.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // What came since the last call, or comes within that time; 0: none, or of child processes.
  [[nodiscard]] int wait(std::chrono::milliseconds longest);

 private:
  struct Former {
    int number = 0;
    struct sigaction action {};
  };
  std::vector<Former> former_{};
};

// Ends this process as the signal would have, so that a shell sees it.
[[noreturn]] void end_by(int signal_number);

}  // namespace trc::cli
