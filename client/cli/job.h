#pragma once

#include <functional>
#include <optional>
#include <string>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/reporter.h"
#include "client/cli/service.h"
#include "trc/v1/job_record.pb.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// One program to compensate, and the record of how that went.
struct Job {
  ServiceOptions service{};
  v1::ProgramSetup setup{};
  std::string format = "nc";                      // as --format
  std::string input_name{};                       // for the record
  std::string output_name{};                      // likewise
  bool recorded = false;                          // the record is wanted
  std::optional<wire::ProgramSummary> summary{};  // of one that was compensated
  v1::JobRecord record{};  // whole where the program was compensated or refused
};

// Takes a piece of the result. False: no more is wanted.
using TextSink = std::function<bool(const std::string& text)>;

// Diagnostics and other faults are on standard error when it returns.
[[nodiscard]] Exit do_job(Job& job, Input& input, Reporter& reporter, const TextSink& sink);

}  // namespace trc::cli
