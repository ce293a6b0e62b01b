#include "server/rpc/meter.h"

#include <array>
#include <cstdint>
#include <ctime>

namespace trc::server {
namespace {

double thread_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Blocks that went in and have not come out. Inserted blocks come out without having gone in, so
// only the origins that stand for one input block each are counted.
std::uint64_t held_blocks(const Summary& summary) {
  constexpr std::array one_for_one{Origin::programmed,  Origin::masked,
                                   Origin::kerf,        Origin::converted_circle,
                                   Origin::passthrough, Origin::uncompensated};
  std::uint64_t out = 0;
  for (const Origin origin : one_for_one)
    out += summary.blocks_by_origin[static_cast<std::size_t>(origin)];
  return summary.blocks_in > out ? summary.blocks_in - out : 0;
}

// A block inside the passes, with what its vectors add.
constexpr std::uint64_t held_block_bytes = 800;

}  // namespace

Meter::Running::Running(Meter& meter) : meter_(meter), started_s_(thread_cpu_seconds()) {}

Meter::Running::~Running() { meter_.cpu_seconds_ += thread_cpu_seconds() - started_s_; }

bool Meter::holds(const Summary& so_far, std::size_t outbox_bytes) {
  return share_.resize(held_blocks(so_far) * held_block_bytes + outbox_bytes);
}

wire::PathSummary Meter::summary(const Summary& core, const Diagnostics& diagnostics) const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started_;
  return {.summary = core,
          .notes = diagnostics.count(Severity::note),
          .warnings = diagnostics.count(Severity::warning),
          .wall_time_seconds = wall.count(),
          .cpu_time_seconds = cpu_seconds_};
}

}  // namespace trc::server
