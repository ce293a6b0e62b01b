#pragma once

#include <string>

#include "server/config/config.h"
#include "server/resources/memory_budget.h"
#include "server/resources/memory_watch.h"
#include "server/resources/peers.h"
#include "server/rpc/resume_tokens.h"
#include "server/rpc/run_taps.h"
#include "server/telemetry/telemetry.h"
#include "server/work/open_streams.h"
#include "server/work/pulse.h"
#include "server/work/worker_pool.h"

namespace trc::server {

// What every RPC of one server shares.
struct Backend {
  // Limits the settings leave open are filled in (fill_in_limits).
  Backend(const Config& settings, std::string resume_key);

  // Updates the gauges, which nothing else sets.
  void refresh_gauges();

  const Config config;
  Telemetry telemetry;
  MemoryBudget memory;
  Peers peers;
  const ResumeTokens resume_tokens;
  RunTaps run_taps;
  OpenStreams streams;
  // After the members that their threads use, so that they end first.
  MemoryWatch memory_watch;
  // Before the pool, which gives the last beat a turn.
  Pulse pulse;
  WorkerPool pool;
};

}  // namespace trc::server
