#include "server/resources/limits.h"

#include <algorithm>

#include "server/net/address.h"

namespace trc::server {
namespace {

constexpr std::uint64_t mib = 1U << 20U;
// The program itself, its threads, and gRPC without streams.
constexpr std::uint64_t base_mib = 64;
// The least that holds one stream, with a quarter for the program.
constexpr std::uint64_t least_mib = 16;
constexpr std::uint64_t usual_session_mib = 1024;
constexpr std::uint64_t usual_streams = 1000;
constexpr std::uint64_t usual_http_mib = 512;
// The largest answer (Answers).
constexpr std::uint64_t answer_bytes = 192U << 10U;

// One incoming and one outgoing message.
std::uint64_t buffer_of_stream(const Config& config) {
  return config.max_message_bytes + std::min<std::uint64_t>(answer_bytes, config.max_message_bytes);
}

std::uint64_t in_mib(std::uint64_t bytes) { return (bytes + mib - 1) / mib; }

// The default for a single peer: never everything.
template <class Number>
Number most_of(Number all) {
  return std::max<Number>(1, all - all / 4);
}

template <class Number>
void fill_in(Number& setting, std::uint64_t value) {
  if (setting == 0) setting = static_cast<Number>(std::max<std::uint64_t>(value, 1));
}

}  // namespace

std::optional<std::string> fill_in_limits(Config& config, std::uint64_t memory_bytes) {
  fill_in(config.memory_limit_mib, std::min<std::uint64_t>(memory_bytes / mib, 1U << 30U));
  const std::uint64_t whole = config.memory_limit_mib;
  if (whole < least_mib)
    return "memory-limit-mib: the server needs " + std::to_string(least_mib) + " or more, not " +
           std::to_string(whole);
  fill_in(config.http_max_memory_mib, std::min(usual_http_mib, whole / 4));
  // If all clients are on this machine, there is no other peer to keep a share for.
  const bool has_one_peer = is_local_address(config.http_listen);
  const auto share_of = [&](std::uint64_t all) { return has_one_peer ? all : most_of(all); };
  fill_in(config.http_max_connections_per_peer, share_of(config.http_max_connections));
  fill_in(config.http_max_memory_per_peer_mib, share_of(config.http_max_memory_mib));
  // A larger body would be accepted and then find no room.
  config.http_max_body_mib = std::min(
      {config.http_max_body_mib, config.http_max_memory_mib, config.http_max_memory_per_peer_mib});
  const std::uint64_t http = config.http_listen.empty() ? 0 : config.http_max_memory_mib;
  // The memory that HTTP leaves to the rest.
  const std::uint64_t limit = whole - std::min(http, whole);
  const std::uint64_t base = std::min(base_mib, limit / 4);
  fill_in(config.max_session_memory_mib, std::min(usual_session_mib, limit / 2));
  const std::uint64_t each = buffer_of_stream(config);
  const std::uint64_t wanted = config.max_streams == 0 ? usual_streams : config.max_streams;
  fill_in(config.max_grpc_buffer_mib, std::min(in_mib(wanted * each), limit / 4));
  fill_in(config.max_streams,
          std::min(usual_streams, std::uint64_t{config.max_grpc_buffer_mib} * mib / each));
  fill_in(config.max_streams_per_peer, most_of(config.max_streams));
  fill_in(config.max_memory_per_peer_mib, most_of(config.max_session_memory_mib));

  // A token comes back inside a message, which holds more than the token.
  config.max_resume_token_bytes =
      std::min(config.max_resume_token_bytes, config.max_message_bytes / 2);
  const std::uint64_t buffers = in_mib(config.max_streams * each);
  if (buffers > config.max_grpc_buffer_mib)
    return "max-grpc-buffer-mib: " + std::to_string(config.max_streams) +
           " streams (max-streams) with messages of " + std::to_string(config.max_message_bytes) +
           " bytes (max-message-bytes) need " + std::to_string(buffers) + ", not " +
           std::to_string(config.max_grpc_buffer_mib);
  const std::uint64_t sum =
      std::uint64_t{config.max_session_memory_mib} + config.max_grpc_buffer_mib + http + base;
  if (sum > whole)
    return std::string("memory-limit-mib: max-session-memory-mib, max-grpc-buffer-mib") +
           (http > 0 ? ", http-max-memory-mib" : "") + " and " + std::to_string(base) +
           " for the program need " + std::to_string(sum) + ", not " + std::to_string(whole);
  return std::nullopt;
}

std::optional<std::string> fill_in_own_limits(Config& config, std::uint64_t memory_bytes) {
  const std::uint64_t memory =
      config.memory_limit_mib > 0 ? config.memory_limit_mib * mib : memory_bytes;
  constexpr std::uint64_t plenty = 1024 * mib;
  if (config.max_session_memory_mib == 0 && memory > plenty)
    config.max_session_memory_mib = static_cast<std::uint32_t>(memory / mib / 8 * 5);
  if (config.max_memory_per_peer_mib == 0)
    config.max_memory_per_peer_mib = config.max_session_memory_mib;
  return fill_in_limits(config, memory_bytes);
}

}  // namespace trc::server
