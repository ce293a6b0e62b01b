#include "server/backend.h"

#include <prometheus/gauge.h>

#include <chrono>
#include <utility>

namespace trc::server {

Backend::Backend(const Config& settings, std::string resume_key)
    : config(settings),
      telemetry(settings.log_level),
      memory(std::uint64_t{settings.max_session_memory_mib} << 20U),
      resume_tokens(std::move(resume_key), settings.max_resume_token_bytes),
      streams(settings.max_streams, std::chrono::seconds(settings.idle_timeout_s),
              std::chrono::seconds(settings.heartbeat_s)),
      pool(settings.worker_threads) {
  telemetry.metrics.set_limits(settings.max_streams, memory.most_bytes());
}

void Backend::refresh_gauges() {
  telemetry.metrics.streams_active().Set(static_cast<double>(streams.count()));
  telemetry.metrics.session_memory().Set(static_cast<double>(memory.used_bytes()));
  telemetry.metrics.queue_depth().Set(static_cast<double>(pool.queue_depth()));
}

}  // namespace trc::server
