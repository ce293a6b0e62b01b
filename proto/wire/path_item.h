#pragma once

#include <cstdint>

#include "core/trc/compensator.h"
#include "core/verify/clearance.h"
#include "trc/v1/path_item.pb.h"

namespace trc::wire {

// What a finished stream of blocks did.
struct PathSummary {
  Summary summary{};
  verify::ClearanceReport clearance{};  // empty unless the setup asks for it
  double effective_radius = 0;          // at the end, mm, and of it:
  double wear = 0;
  double allowance = 0;
  double nominal_radius = 0;
  std::uint64_t notes = 0;
  std::uint64_t warnings = 0;
  double wall_time_seconds = 0;
  double cpu_time_seconds = 0;
};

// What a finished stream of NC text did.
struct ProgramSummary {
  PathSummary path{};
  std::uint64_t lines_in = 0;
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
};

void to_proto(const PathSummary& summary, v1::PathSummary& message);
// Of what has a worst place.
void to_proto(const verify::ClearanceReport& report, v1::Certificate& message);
void to_proto(const ProgramSummary& summary, v1::ProgramSummary& message);
[[nodiscard]] PathSummary from_proto(const v1::PathSummary& message);
[[nodiscard]] ProgramSummary from_proto(const v1::ProgramSummary& message);

}  // namespace trc::wire
