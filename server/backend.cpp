#include "server/backend.h"

#include <prometheus/gauge.h>

#include <chrono>
#include <utility>

#include "server/resources/limits.h"

namespace trc::server {
namespace {

// Server::start has already reported the fault of these limits, if any.
Config filled_in(Config settings) {
  static_cast<void>(fill_in_limits(settings, memory_limit_bytes()));
  return settings;
}

}  // namespace

Backend::Backend(const Config& settings, std::string resume_key)
    : config(filled_in(settings)),
      telemetry(config),
      memory(std::uint64_t{config.max_session_memory_mib} << 20U),
      peers(std::uint64_t{config.max_memory_per_peer_mib} << 20U),
      resume_tokens(std::move(resume_key), config.max_resume_token_bytes),
      streams(config.max_streams, std::chrono::seconds(config.idle_timeout_s),
              std::chrono::seconds(config.heartbeat_s)),
      memory_watch({.limit_bytes = std::uint64_t{config.memory_limit_mib} << 20U,
                    .end_largest =
                        [this] {
                          if (streams.evict_largest()) telemetry.metrics.count_eviction();
                        },
                    .is_one_ending = [this] { return streams.is_evicting(); },
                    .counted_bytes = [this] { return memory.used_bytes(); },
                    .resident_bytes = resident_bytes}),
      pulse(std::chrono::seconds(config.stall_timeout_s)),
      pool(config.worker_threads) {
  pulse.attach(pool);
  telemetry.metrics.set_limits(config.max_streams, memory.most_bytes(), memory_watch.limit_bytes());
}

void Backend::refresh_gauges() {
  telemetry.metrics.streams_active().Set(static_cast<double>(streams.count()));
  telemetry.metrics.session_memory().Set(static_cast<double>(memory.used_bytes()));
  telemetry.metrics.peers_active().Set(static_cast<double>(peers.count()));
  telemetry.metrics.resident_memory().Set(static_cast<double>(resident_bytes()));
  telemetry.metrics.queue_depth().Set(static_cast<double>(pool.queue_depth()));
  telemetry.metrics.set_pool(pulse.longest_wait_s(), pool.threads_missed());
  telemetry.metrics.set_log(Log::counts());
}

}  // namespace trc::server
