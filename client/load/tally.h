#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "client/load/histogram.h"
#include "client/load/process_meter.h"

namespace trc::load {

using Clock = std::chrono::steady_clock;

// The counts of the measured time of a run.
struct Tally {
  // Answers within the measured time, whichever stream they belong to.
  std::uint64_t blocks_in = 0;
  std::uint64_t blocks_out = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t bytes_received = 0;
  Histogram batch{};  // from sending a batch to its last answer

  // Of streams meant to begin while it is measured, but slow readers and cancelled ones. From the
  // intended start.
  Histogram first_output{};
  Histogram stream{};

  // Streams that ended while it was measured, or because its time was over.
  std::uint64_t completed = 0;
  std::uint64_t cancelled = 0;   // on purpose
  std::uint64_t slow = 0;        // read slowly on purpose, and completed
  std::uint64_t unfinished = 0;  // counted in `stream` with the time they had taken in an open loop
  std::map<std::string, std::uint64_t> errors{};  // by status, and by reason where there is one
  std::string first_error{};                      // a sentence

  std::uint64_t verified = 0;  // streams compared with the core of this process
  std::uint64_t differing = 0;
  std::string first_difference{};
};

// The outcome of a run.
struct Outcome {
  Tally tally{};
  double seconds = 0;  // measured
  bool interrupted = false;
  // Open loop: how late the generator itself was with a stream it could have begun, at worst.
  Clock::duration generator_lag{};
  std::uint64_t most_open = 0;

  // CPU time while it was measured.
  double own_cpu_s = 0;
  struct Server {
    pid_t process = 0;
    double cpu_s = 0;
    double system_s = 0;
    double resident_mib_first = 0;  // at the start
    double resident_mib_warm = 0;   // a second later
    double resident_mib_most = 0;   // from then on
    double resident_mib_least = 0;  // from then on
    double resident_mib_last = 0;
  };
  std::optional<Server> server{};
};

}  // namespace trc::load
