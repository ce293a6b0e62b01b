#pragma once

#include <optional>
#include <vector>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "core/base/diagnostic.h"
#include "core/nc/state/block.h"
#include "core/trc/lead_settings.h"
#include "core/trc/result/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/path_item.h"

namespace trc::cli {

// A program before and after compensation, both as blocks.
struct ProgramPaths {
  Exit exit = Exit::done;
  // As read here, without the service. Where the text has an error they end
  // there; the error is among `diagnostics`, from the service.
  std::vector<Block> programmed{};
  std::vector<CompensatedBlock> compensated{};  // what was certain, if refused
  std::vector<Diagnostic> diagnostics{};        // also told on standard error
  // Whether the program counts in inch where it first compensates, else where it first moves.
  bool inch = false;
  LeadSettings leads{};                           // of the setup
  Position start{};                               // of the setup
  std::optional<wire::ProgramSummary> summary{};  // complete runs only
};

[[nodiscard]] ProgramPaths read_paths(const ProgramOptions& options, v1::ProgramSetup setup,
                                      Input& input);

}  // namespace trc::cli
