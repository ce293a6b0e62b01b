#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/cli/entry_help_text.h"
#include "proto/wire/diagnostic.h"

namespace trc::cli {

// "FILE:LINE: error 90019: message (remedy)", one line; without line when the
// diagnostic has none.
[[nodiscard]] std::string line_for(std::string_view file,
                                   const wire::ReceivedDiagnostic& diagnostic);

// "FILE:LINE: help 900201: …" for each line of what would do instead; none: nothing is known.
[[nodiscard]] std::vector<std::string> help_lines_for(std::string_view file,
                                                      const Diagnostic& diagnostic,
                                                      const Writing& writing);

}  // namespace trc::cli
