#pragma once

#include <chrono>
#include <optional>
#include <random>

#include "client/trc/connection.h"

namespace trc::client {

// Patience with a lost server, and the waits between attempts to go on: doubling, spread at random
// so that the clients of a server that restarts do not come back at one moment.
class ResumeClock {
 public:
  explicit ResumeClock(const ResumePolicy& policy);

  // There was progress: patience and waits begin anew.
  void restart();
  // Sleeps before the next attempt, at least as long as the server asks for. False when that would
  // be longer than patience is left.
  [[nodiscard]] bool wait(std::optional<double> at_least_seconds);

  // Takes the time of an attempt off the patience, as long as it lives.
  class Attempt {
   public:
    explicit Attempt(ResumeClock& clock) : clock_(clock) {}
    ~Attempt() { clock_.spent_ += Clock::now() - started_; }
    Attempt(const Attempt&) = delete;
    Attempt& operator=(const Attempt&) = delete;

   private:
    ResumeClock& clock_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  };

 private:
  using Clock = std::chrono::steady_clock;

  ResumePolicy policy_;
  Clock::duration spent_{};
  std::chrono::milliseconds next_;
  std::minstd_rand random_;
};

}  // namespace trc::client
