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

  void received(std::uint64_t blocks);
  void sent(std::uint64_t blocks);
  // All answers to the last request are out.
  void answered();
  void ended(const Ending& ending);

  // A bug: logs what was thrown, and returns the status with the incident's id.
  Ending incident(std::string_view what);

 private:
  void add_trace(LogLine& line) const;

  using Clock = std::chrono::steady_clock;

  Telemetry& telemetry_;
  const Metrics::OfMethod& metrics_;
  Method method_;
  std::string peer_;
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
