#include "server/rpc/meter.h"

#include <algorithm>
#include <ctime>

namespace trc::server {
namespace {

double thread_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Meter::Running::Running(Meter& meter) : meter_(meter), started_s_(thread_cpu_seconds()) {}

Meter::Running::~Running() { meter_.cpu_seconds_ += thread_cpu_seconds() - started_s_; }

// Only the output shows how much the passes hold: all blocks read since something last came out, or
// a full window.
bool Meter::note(const Summary& so_far) {
  const bool came_out = so_far.blocks_out > blocks_out_;
  if (came_out) {
    blocks_out_ = so_far.blocks_out;
    released_through_ = blocks_in_;
  }
  blocks_in_ = so_far.blocks_in;
  held_blocks_ = std::max(blocks_in_ - released_through_, std::min(look_ahead_blocks_, blocks_in_));
  return came_out;
}

wire::PathSummary Meter::summary_of(const Summary& core, const Diagnostics& diagnostics) const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started_;
  return {.summary = core,
          .notes = diagnostics.count(Severity::note),
          .warnings = diagnostics.count(Severity::warning),
          .wall_time_seconds = wall.count(),
          .cpu_time_seconds = cpu_seconds_};
}

}  // namespace trc::server
