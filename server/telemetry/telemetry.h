#pragma once

#include <string_view>

#include "server/telemetry/log.h"
#include "server/telemetry/metrics.h"

namespace trc::server {

struct Telemetry {
  explicit Telemetry(std::string_view log_level) : log(log_level) {}

  Log log;
  Metrics metrics;
};

}  // namespace trc::server
