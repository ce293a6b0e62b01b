#include "client/load/use_meter.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>

namespace trc::load {
namespace {

constexpr std::chrono::milliseconds between_looks{100};
// By then the server has allocated what it needs only once: pools, caches, the first streams.
constexpr std::chrono::seconds warm_after{1};

}  // namespace

UseMeter::Uses UseMeter::uses() const {
  return {.own = use_of(getpid()).value_or(ProcessUse{}),
          .server = server_ == 0 ? std::nullopt : use_of(server_)};
}

void UseMeter::look() {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + between_looks;
  const Uses now_used = uses();
  if (!first_) {
    first_ = now_used;
    begun_ = now;
  }
  if (now_used.server) note_memory(now_used.server->resident_mib, now - begun_);
}

void UseMeter::note_memory(double resident_mib, Clock::duration since_begin) {
  if (since_begin < warm_after) return;
  if (!warm_mib_) {
    warm_mib_ = most_mib_ = least_mib_ = resident_mib;
  }
  most_mib_ = std::max(most_mib_, resident_mib);
  least_mib_ = std::min(least_mib_, resident_mib);
}

void UseMeter::finish(Outcome& outcome) {
  next_ = {};
  look();
  const Uses last = uses();
  outcome.own_cpu_s = last.own.cpu_s - first_->own.cpu_s;
  if (!first_->server || !last.server) return;
  const double resident_mib = last.server->resident_mib;
  outcome.server = {.process = server_,
                    .cpu_s = last.server->cpu_s - first_->server->cpu_s,
                    .system_s = last.server->system_s - first_->server->system_s,
                    .resident_mib_first = first_->server->resident_mib,
                    .resident_mib_warm = warm_mib_.value_or(resident_mib),
                    .resident_mib_most = warm_mib_ ? most_mib_ : resident_mib,
                    .resident_mib_least = warm_mib_ ? least_mib_ : resident_mib,
                    .resident_mib_last = resident_mib};
}

}  // namespace trc::load
