#pragma once

#include <atomic>
#include <memory>

#include "core/session/path_session.h"
#include "server/backend.h"
#include "server/rpc/stream_account.h"
#include "server/telemetry/call_record.h"

namespace trc::server {

// Thrown to leave work whose result is no longer wanted.
struct Abandoned {};

// The data that the work of one stream shares with its reactor.
struct StreamContext {
  Backend& backend;
  CallRecord& record;
  // Set when the result is no longer wanted; work checks it every few blocks.
  const std::atomic<bool>& cancelled;
  StreamAccount& account;
  std::shared_ptr<RunTap> run_tap{};  // may be null

  // To be called again and again by long work: ends it when it is abandoned or passes a limit, and
  // yields to other streams.
  void pass() const {
    if (cancelled.load(std::memory_order_relaxed)) throw Abandoned{};
    if (!account.is_due()) return;
    account.check();
    backend.pool.give_way();
  }
  [[nodiscard]] SessionSetup interruptible(SessionSetup setup) const {
    setup.compensator.interrupt = [stream = *this] { stream.pass(); };
    tell_measuring(setup);
    return setup;
  }
  // What is measured of the path shows in heartbeats.
  void tell_measuring(SessionSetup& setup) const {
    setup.measuring = [&account = account](std::size_t measured, std::size_t all) {
      account.measures({.blocks = measured, .all = all});
    };
  }
};

}  // namespace trc::server
