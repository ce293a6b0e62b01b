#pragma once

#include <atomic>

#include "core/session/session.h"
#include "server/backend.h"
#include "server/telemetry/call_record.h"

namespace trc::server {

// Thrown out of work whose result nobody waits for any more.
struct Abandoned {};

// What the work of one stream shares with its reactor.
struct StreamContext {
  Backend& backend;
  CallRecord& record;
  // Set when nobody waits for the result any more; work looks at it every few blocks.
  const std::atomic<bool>& cancelled;

  // For the core: long work ends when it is abandoned, and gives way to other streams.
  [[nodiscard]] SessionSetup interruptible(SessionSetup setup) const {
    setup.compensator.interrupt = [&pool = backend.pool, &abandoned = cancelled] {
      if (abandoned) throw Abandoned{};
      pool.give_way();
    };
    return setup;
  }
};

}  // namespace trc::server
