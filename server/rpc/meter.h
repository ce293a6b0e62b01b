#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

#include "core/base/diagnostics.h"
#include "core/nc/state/program_state.h"
#include "core/trc/compensator.h"
#include "proto/wire/path_item.h"

namespace trc::server {

// The work of a session and the blocks it holds back, as far as visible from outside.
class Meter {
 public:
  explicit Meter(const Limits& limits) : look_ahead_blocks_(limits.look_ahead_blocks) {}

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

  // To be called after every request. Returns whether there was output.
  bool note(const Summary& so_far);

  // Whether so few blocks were held at the last call that releasing them takes little
  // time.
  [[nodiscard]] bool holds_few() const { return held_blocks_ <= few_blocks; }
  // This many take no longer than two changes of thread.
  static constexpr std::uint64_t few_blocks = 128;

  template <class Session>
  [[nodiscard]] wire::PathSummary summary(const Session& session) const {
    wire::PathSummary summary = summary_of(session.summary(), session.diagnostics());
    if (const auto* clearance = session.clearance()) summary.clearance = *clearance;
    const RadiusTerms& radius = session.radius_terms();
    summary.effective_radius = std::abs(radius.effective());
    summary.wear = radius.wear;
    summary.allowance = radius.allowance;
    summary.nominal_radius = radius.nominal;
    return summary;
  }

  // Times count from where a stream goes on.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(blocks_in_, blocks_out_, released_through_);
  }

 private:
  [[nodiscard]] wire::PathSummary summary_of(const Summary& core,
                                             const Diagnostics& diagnostics) const;

  std::uint64_t look_ahead_blocks_;
  std::uint64_t blocks_in_ = 0;
  std::uint64_t blocks_out_ = 0;
  std::uint64_t held_blocks_ = 0;
  std::uint64_t released_through_ = 0;  // input up to here was taken when something came out last
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  double cpu_seconds_ = 0;
};

}  // namespace trc::server
