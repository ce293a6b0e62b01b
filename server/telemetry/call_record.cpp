#include "server/telemetry/call_record.h"

#include <prometheus/counter.h>
#include <prometheus/histogram.h>

#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <random>
#include <utility>

namespace trc::server {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string new_incident_id() {
  std::random_device random;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x%08x", random(), random());
  return digits.data();
}

}  // namespace

CallRecord::CallRecord(Telemetry& telemetry, Method method, std::string peer, Trace trace)
    : telemetry_(telemetry),
      metrics_(telemetry.metrics.of(method)),
      method_(method),
      peer_(std::move(peer)),
      call_(telemetry.connections.begin(peer_)),
      trace_(std::move(trace)) {
  metrics_.started->Increment();
}

void CallRecord::received(std::uint64_t blocks) {
  received_ = Clock::now();
  ++messages_in_;
  blocks_in_ += blocks;
  metrics_.received->Increment();
  metrics_.blocks_in->Increment(static_cast<double>(blocks));
}

void CallRecord::taken(std::uint64_t blocks) {
  blocks_in_ += blocks;
  metrics_.blocks_in->Increment(static_cast<double>(blocks));
}

void CallRecord::given(std::uint64_t blocks) {
  blocks_out_ += blocks;
  metrics_.blocks_out->Increment(static_cast<double>(blocks));
}

void CallRecord::sent(std::uint64_t blocks) {
  ++messages_out_;
  blocks_out_ += blocks;
  metrics_.sent->Increment();
  metrics_.blocks_out->Increment(static_cast<double>(blocks));
}

void CallRecord::answered() { metrics_.batch->Observe(seconds_since(received_)); }

void CallRecord::ended(const Ending& ending) noexcept {
  try {
    const double seconds = seconds_since(started_);
    // A call that has given an answer or run for a while was not an early cancel.
    using End = Connections::Call::End;
    const bool cancelled = ending.status.error_code() == grpc::StatusCode::CANCELLED;
    call_.ended(cancelled && blocks_out_ == 0 && seconds < 1 ? End::early
                : ending.status.ok() || cancelled            ? End::done
                                                             : End::refused);
    metrics_.handling->Observe(seconds);
    telemetry_.metrics.count_handled(method_, name_of(ending.status.error_code()));
    if (!ending.reason.empty()) telemetry_.metrics.count_error(ending.reason);
    log_end(ending, seconds);
  } catch (const std::bad_alloc&) {
    // The call ends even if there is no memory to record it.
  }
}

void CallRecord::log_end(const Ending& ending, double seconds) const {
  const std::string_view code = name_of(ending.status.error_code());
  LogLine line("rpc");
  line.text("method", name_of(method_)).text("peer", peer_).text("code", code);
  if (!ending.reason.empty()) line.text("reason", ending.reason);
  if (!ending.status.ok()) line.text("message", ending.status.error_message());
  if (!client_tag_.empty()) line.text("client_tag", client_tag_);
  add_trace(line, trace_);
  line.number("blocks_in", blocks_in_)
      .number("blocks_out", blocks_out_)
      .number("messages_in", messages_in_)
      .number("messages_out", messages_out_)
      .number("ms", seconds * 1e3);
  telemetry_.log.info(line);
}

Ending CallRecord::incident(std::string_view what) noexcept {
  try {
    const std::string id = new_incident_id();
    LogLine line("incident");
    line.text("incident_id", id).text("method", name_of(method_)).text("what", what);
    add_trace(line, trace_);
    telemetry_.log.error(line);
    return refuse(Refusal::internal, "incident " + id, {{"incident_id", id}});
  } catch (const std::exception&) {
    return out_of_memory();
  }
}

Ending CallRecord::out_of_memory() noexcept {
  try {
    return refuse(Refusal::memory_limit);
  } catch (const std::exception&) {
    // These texts need no heap. Without a reason the client treats the stream as lost and goes on
    // elsewhere, as it should.
    return {.status = grpc::Status(grpc::StatusCode::RESOURCE_EXHAUSTED, "no memory"),
            .reason = "MEMORY_LIMIT"};
  }
}

}  // namespace trc::server
