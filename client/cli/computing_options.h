#pragma once

#include <string>

#include "client/cli/program_options.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// Enters the values of --variable, --subprograms and --max-executed-lines. Empty, or the fault.
[[nodiscard]] std::string add_computing_options(const ProgramOptions& options,
                                                v1::ProgramSetup& setup);

}  // namespace trc::cli
