#pragma once

#include <string>

#include "client/load/job.h"
#include "client/load/plan.h"
#include "client/load/tally.h"
#include "core/base/language.h"

namespace trc::load {

// The description of the run for its report.
struct RunDescription {
  std::string server{};  // empty: in this process
  std::string shape{};
  std::size_t connections = 1;
};

[[nodiscard]] std::string report_text(const RunDescription& run, const Plan& plan, const Job& job,
                                      const Outcome& outcome,
                                      Language language = Language::english);
// One object on one line. Durations in ms.
[[nodiscard]] std::string report_json(const RunDescription& run, const Plan& plan, const Job& job,
                                      const Outcome& outcome);

}  // namespace trc::load
