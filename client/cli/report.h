#pragma once

#include <string>
#include <string_view>

#include "proto/wire/diagnostic.h"

namespace trc::cli {

// "FILE:LINE: error 90019: message (remedy)", one line; without line when the
// diagnostic has none.
[[nodiscard]] std::string line_for(std::string_view file,
                                   const wire::ReceivedDiagnostic& diagnostic);

}  // namespace trc::cli
