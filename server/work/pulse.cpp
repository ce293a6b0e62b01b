#include "server/work/pulse.h"

#include <algorithm>

namespace trc::server {

void Pulse::beat() {
  if (waiting_since_.load() != Clock::duration::zero()) return;
  waiting_since_ = Clock::now().time_since_epoch();
  pool_->submit(*this);
}

Pulse::Clock::duration Pulse::beat_waits() const {
  const Clock::duration since = waiting_since_;
  return since == Clock::duration::zero() ? since : Clock::now().time_since_epoch() - since;
}

double Pulse::longest_wait_s() const {
  return std::chrono::duration<double>(
             std::max<Clock::duration>(pool_->longest_wait(), beat_waits()))
      .count();
}

bool Pulse::stalled() const {
  return std::max<Clock::duration>(pool_->longest_wait(), beat_waits()) > longest_wait_;
}

bool Pulse::dead() const { return beat_waits() > 3 * longest_wait_; }

}  // namespace trc::server
