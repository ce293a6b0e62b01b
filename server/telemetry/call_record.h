#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/rpc/status.h"
#include "server/telemetry/telemetry.h"
#include "server/telemetry/trace.h"

namespace trc::server {

// What is known about one RPC for log and metrics. Counts are handed to the metrics once per
// message, and one line is logged at the end.
class CallRecord {
 public:
  CallRecord(Telemetry& telemetry, Method method, std::string peer, Trace trace);

  // Chosen by the client; goes to the log only, since a label of a metric must not be.
  void set_client_tag(std::string_view tag) { client_tag_ = tag; }

  [[nodiscard]] const Trace& trace() const { return trace_; }

  // A message of so many bytes has come.
  void carried(std::uint64_t bytes) { call_.carried(bytes); }
  void received(std::uint64_t blocks);
  // Blocks of a request that were not known when it was received.
  void taken(std::uint64_t blocks);
  // Blocks that go out in answers as text.
  void given(std::uint64_t blocks);
  void sent(std::uint64_t blocks);
  // All answers to the last request are out.
  void answered();
  // Without memory for a line, nothing is logged.
  void ended(const Ending& ending) noexcept;

  // A bug: logs what was thrown, and returns the status with the incident's id.
  Ending incident(std::string_view what) noexcept;
  // The heap has nothing left.
  [[nodiscard]] static Ending out_of_memory() noexcept;

 private:
  void log_end(const Ending& ending, double seconds) const;

  using Clock = std::chrono::steady_clock;

  Telemetry& telemetry_;
  const Metrics::OfMethod& metrics_;
  Method method_;
  std::string peer_;
  Connections::Call call_;
  Trace trace_;
  std::string client_tag_;
  Clock::time_point started_ = Clock::now();
  Clock::time_point received_ = started_;
  std::uint64_t messages_in_ = 0;
  std::uint64_t messages_out_ = 0;
  std::uint64_t blocks_in_ = 0;
  std::uint64_t blocks_out_ = 0;
};

}  // namespace trc::server
