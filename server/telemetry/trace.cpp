#include "server/telemetry/trace.h"

#include <array>
#include <cstdio>
#include <random>

#include "server/telemetry/log.h"

namespace trc::server {
namespace {

constexpr std::string_view digits = "0123456789abcdef";

bool is_id(std::string_view text) {
  return text.find_first_not_of(digits) == std::string_view::npos &&
         text.find_first_not_of('0') != std::string_view::npos;
}

std::string random_id(std::size_t length) {
  // Ids must differ; they need not be secret.
  thread_local std::mt19937_64 random{std::random_device{}()};
  std::string id;
  while (id.size() < length) {
    std::array<char, 17> part{};
    std::snprintf(part.data(), part.size(), "%016llx",
                  static_cast<unsigned long long>(random() | 1U));
    id += part.data();
  }
  return id;
}

}  // namespace

std::optional<Trace> read_traceparent(std::string_view header) {
  constexpr std::size_t length = 55;  // 00-<32>-<16>-<2>
  if (header.size() < length || header[2] != '-' || header[35] != '-' || header[52] != '-')
    return std::nullopt;
  const std::string_view version = header.substr(0, 2);
  const std::string_view flags = header.substr(53, 2);
  const auto is_hex = [](std::string_view text) {
    return text.find_first_not_of(digits) == std::string_view::npos;
  };
  if (!is_hex(version) || version == "ff" || !is_hex(flags)) return std::nullopt;
  // Later versions may append fields.
  if (header.size() > length && (version == "00" || header[length] != '-')) return std::nullopt;
  const std::string_view trace_id = header.substr(3, 32);
  const std::string_view parent_id = header.substr(36, 16);
  if (!is_id(trace_id) || !is_id(parent_id)) return std::nullopt;
  return Trace{.trace_id = std::string(trace_id), .parent_id = std::string(parent_id)};
}

Trace trace_of(std::string_view traceparent) {
  Trace trace = read_traceparent(traceparent).value_or(Trace{});
  if (trace.trace_id.empty()) trace.trace_id = random_id(32);
  trace.span_id = random_id(16);
  return trace;
}

std::string traceparent_of(const Trace& trace) {
  return "00-" + trace.trace_id + "-" + trace.span_id + "-00";
}

void add_trace(LogLine& line, const Trace& trace) {
  line.text("trace_id", trace.trace_id).text("span_id", trace.span_id);
  if (!trace.parent_id.empty()) line.text("parent_id", trace.parent_id);
}

}  // namespace trc::server
