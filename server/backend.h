#pragma once

#include "server/config.h"
#include "server/memory_budget.h"
#include "server/open_streams.h"
#include "server/telemetry/telemetry.h"
#include "server/worker_pool.h"

namespace trc::server {

// What every RPC of one server shares.
struct Backend {
  explicit Backend(const Config& settings);

  // Brings the gauges up to date, which nobody sets in between.
  void refresh_gauges();

  const Config config;
  Telemetry telemetry;
  MemoryBudget memory;
  OpenStreams streams;
  // Last, so that its threads end before what they work with.
  WorkerPool pool;
};

}  // namespace trc::server
