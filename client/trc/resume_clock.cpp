#include "client/trc/resume_clock.h"

#include <algorithm>
#include <thread>

namespace trc::client {

using std::chrono::duration_cast;

ResumeClock::ResumeClock(const ResumePolicy& policy)
    : policy_(policy), next_(policy.first_wait), random_(std::random_device{}()) {}

void ResumeClock::restart() {
  spent_ = {};
  next_ = policy_.first_wait;
}

bool ResumeClock::wait(std::optional<double> at_least_seconds) {
  std::uniform_real_distribution<double> spread(0.8, 1.2);
  using Seconds = std::chrono::duration<double>;
  Seconds wait = spread(random_) * Seconds(next_);
  next_ = std::min(2 * next_, policy_.longest_wait);
  if (at_least_seconds) wait = std::max(wait, Seconds(*at_least_seconds));
  spent_ += duration_cast<Clock::duration>(wait);
  if (spent_ > policy_.patience) return false;
  std::this_thread::sleep_for(wait);
  return true;
}

}  // namespace trc::client
