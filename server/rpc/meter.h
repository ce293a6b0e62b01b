#pragma once

#include <chrono>
#include <cstddef>

#include "core/base/diagnostics.h"
#include "core/trc/compensator.h"
#include "proto/wire/path_item.h"
#include "server/memory_budget.h"

namespace trc::server {

// What a session costs: time for its summary, memory for the budget of all streams.
class Meter {
 public:
  explicit Meter(MemoryBudget& memory) : share_(memory) {}

  // Counts the CPU time of its thread as long as it lives.
  class Running {
   public:
    explicit Running(Meter& meter);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    Meter& meter_;
    double started_s_;
  };

  // False when all streams together would now hold more than they may.
  bool holds(const Summary& so_far, std::size_t outbox_bytes);

  [[nodiscard]] wire::PathSummary summary(const Summary& core,
                                          const Diagnostics& diagnostics) const;

 private:
  MemoryBudget::Share share_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  double cpu_seconds_ = 0;
};

}  // namespace trc::server
