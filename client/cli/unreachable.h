#pragma once

#include <string>

#include "client/cli/service.h"

namespace trc::cli {

// What is wrong with the files of --tls-ca, --tls-cert and --tls-key, as a sentence; empty where
// nothing is, or none is given. Files that cannot be read are told by whoever opens them.
[[nodiscard]] std::string fault_of_tls_files(const ServiceOptions& options);

// The end of "cannot reach a server at …": what `message`, as gRPC has it, comes to.
[[nodiscard]] std::string why_unreachable(const std::string& message);

}  // namespace trc::cli
