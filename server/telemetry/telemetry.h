#pragma once

#include "server/net/connections.h"
#include "server/telemetry/log.h"
#include "server/telemetry/metrics.h"

namespace trc::server {

struct Config;

// What is known about the work of one server: what was done, and on which connections.
struct Telemetry {
  explicit Telemetry(const Config& config);

  Log log;
  Metrics metrics;
  Connections connections;
};

}  // namespace trc::server
