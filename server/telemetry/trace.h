#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trc::server {

class LogLine;

// One RPC, or request over HTTP, within a trace, as W3C Trace Context names it.
struct Trace {
  std::string trace_id{};   // 32 lower hex digits
  std::string parent_id{};  // 16, the caller's span; empty: the trace begins here
  std::string span_id{};    // 16, of this RPC
};

// What a `traceparent` header says, or nothing when it is not exactly one: then it is ignored, as
// the recommendation demands.
[[nodiscard]] std::optional<Trace> read_traceparent(std::string_view header);

// The trace of an RPC: that of its header with a new span, or a new one.
[[nodiscard]] Trace trace_of(std::string_view traceparent);

// The header that makes what is called a part of this span.
[[nodiscard]] std::string traceparent_of(const Trace& trace);

// For those who join lines of the log.
void add_trace(LogLine& line, const Trace& trace);

}  // namespace trc::server
