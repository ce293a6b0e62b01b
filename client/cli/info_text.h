#pragma once

#include <string>

#include "core/base/language.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::cli {

// Version, limits, settings, options, G functions and diagnostics for reading on a screen.
[[nodiscard]] std::string text_of(const v1::GetServerInfoResponse& info, Language language);

// Markdown tables, as documentation shows them: in English.
[[nodiscard]] std::string markdown_options(const v1::GetServerInfoResponse& info);
[[nodiscard]] std::string markdown_functions(const v1::GetServerInfoResponse& info);
// The treatment of each G function, dialect by dialect.
[[nodiscard]] std::string markdown_dialects();
[[nodiscard]] std::string markdown_diagnostics(const v1::GetServerInfoResponse& info);

}  // namespace trc::cli
