#pragma once

#include <atomic>

#include "server/backend.h"
#include "server/telemetry/call_record.h"

namespace trc::server {

// What the work of one stream shares with its reactor.
struct StreamContext {
  Backend& backend;
  CallRecord& record;
  // Set when nobody waits for the result any more; work looks at it every few blocks.
  const std::atomic<bool>& cancelled;
};

}  // namespace trc::server
