#pragma once

#include <chrono>
#include <cstdint>

namespace trc::load {

// The load put on the server.
struct Plan {
  std::uint64_t streams = 1;  // open at once; in an open loop at most
  double rate = 0;            // streams a second; 0: closed loop
  std::uint64_t jobs = 0;     // ends after so many streams; 0: only with the time
  std::chrono::nanoseconds ramp{};
  std::chrono::nanoseconds duration{std::chrono::seconds(10)};  // after the ramp
  // How long streams may go on when the time is over, before they are cancelled.
  std::chrono::nanoseconds grace{};
  // Shares of the streams.
  double verify = 0;
  double slow = 0;
  double cancel = 0;
  std::uint32_t first_window = 1;  // unanswered batches until the server has said its own number

  [[nodiscard]] bool open_loop() const { return rate > 0; }
};

}  // namespace trc::load
