#pragma once

#include <string>

#include "server/config.h"
#include "server/memory_budget.h"
#include "server/open_streams.h"
#include "server/rpc/resume_tokens.h"
#include "server/telemetry/telemetry.h"
#include "server/worker_pool.h"

namespace trc::server {

// What every RPC of one server shares.
struct Backend {
  Backend(const Config& settings, std::string resume_key);

  // Brings the gauges up to date, which nobody sets in between.
  void refresh_gauges();

  const Config config;
  Telemetry telemetry;
  MemoryBudget memory;
  const ResumeTokens resume_tokens;
  OpenStreams streams;
  // Last, so that its threads end before what they work with.
  WorkerPool pool;
};

}  // namespace trc::server
