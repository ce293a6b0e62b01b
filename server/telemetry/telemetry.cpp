#include "server/telemetry/telemetry.h"

#include <algorithm>
#include <string>

#include "server/config/config.h"

namespace trc::server {
namespace {

// `read_ahead` adds a quarter of the bytes that all streams of a connection may have under way, for
// streams not known yet: gRPC reports a call with one request only when the request has arrived.
Connections::Limits limits_of(const Config& config) {
  const std::uint64_t all =
      std::uint64_t{config.max_streams_per_connection} * config.max_message_bytes;
  return {.early_cancels = config.max_early_cancels,
          .overhead_bytes_per_s = std::uint64_t{config.max_overhead_kib_per_s} << 10U,
          .read_ahead_of_call = config.max_message_bytes,
          .read_ahead = (std::uint64_t{8} << 20U) + all / 4,
          // gRPC's own count does not include streams that their client has reset.
          .calls = std::max(2 * config.max_streams_per_connection, 16U),
          .unfinished = (std::uint64_t{config.max_grpc_buffer_mib} << 20U) / 4 * 3};
}

}  // namespace

Telemetry::Telemetry(const Config& config)
    : log(config.log_level, config.max_log_lines_per_s), connections(limits_of(config)) {
  connections.when_closed([this](const std::string& peer, Connections::Reason reason) {
    metrics.count_connection_closed(name_of(reason));
    log.warning(LogLine("connection_closed").text("peer", peer).text("reason", name_of(reason)));
  });
}

}  // namespace trc::server
