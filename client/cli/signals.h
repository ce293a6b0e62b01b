#pragma once

#include <csignal>
#include <vector>

namespace trc::cli {

// While an object exists, and only one may at a time, the signals to end (SIGINT, SIGTERM, SIGHUP)
// are reported here instead of their usual effect, whichever thread they reach. Ignored signals
// stay ignored.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // Can be read from, for poll, when there is something to take.
  [[nodiscard]] int descriptor() const;
  // The last one that came since the last call; 0: none.
  [[nodiscard]] int take();

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
