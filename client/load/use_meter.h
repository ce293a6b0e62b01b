#pragma once

#include <optional>

#include "client/load/process_meter.h"
#include "client/load/tally.h"

namespace trc::load {

// Follows the resources of this process and the server while the run is measured.
class UseMeter {
 public:
  // `server`: 0: none that can be looked at.
  explicit UseMeter(pid_t server) : server_(server) {}

  // Call it often from the start of the measurement to its end; it looks at the clock itself.
  void look();
  // The last look, and the result.
  void finish(Outcome& outcome);

 private:
  struct Uses {
    ProcessUse own{};
    std::optional<ProcessUse> server{};
  };
  [[nodiscard]] Uses uses() const;
  void note_memory(double resident_mib, Clock::duration since_begin);

  pid_t server_;
  Clock::time_point begun_{};
  Clock::time_point next_{};
  std::optional<Uses> first_;
  std::optional<double> warm_mib_;
  double most_mib_ = 0;
  double least_mib_ = 0;
};

}  // namespace trc::load
