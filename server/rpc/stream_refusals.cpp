#include "server/rpc/stream_refusals.h"

#include <string>

namespace trc::server {

std::optional<Ending> refuse_crowd(const Backend& backend, const Peer& peer) {
  const std::uint32_t most = backend.config.max_streams_per_peer;
  if (peer.streams() <= most) return std::nullopt;
  return refuse(Refusal::stream_limit_of_peer, {},
                {{"max_streams_per_peer", std::to_string(most)}});
}

Ending refuse_full(const Config& config) {
  return refuse(Refusal::stream_limit, {}, {{"max_streams", std::to_string(config.max_streams)}});
}

Ending refuse_too_large(std::size_t bytes, const Config& config) {
  const std::string size = std::to_string(bytes);
  const std::string most = std::to_string(config.max_message_bytes);
  return refuse(Refusal::message_too_large, size + " > " + most + " bytes",
                {{"message_bytes", size}, {"max_message_bytes", most}});
}

Ending refuse_waiting(Refusal why, const Config& config) {
  if (why != Refusal::stream_idle) return refuse(why);
  return refuse(why, {}, {{"idle_timeout_s", std::to_string(config.idle_timeout_s)}});
}

Turn end_for_want_of_memory() noexcept {
  return end(
      {.status = grpc::Status(grpc::RESOURCE_EXHAUSTED, "no memory"), .reason = "MEMORY_LIMIT"});
}

}  // namespace trc::server
