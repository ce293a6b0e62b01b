#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace trc::cli {

// The fault of a call that cannot be parsed, for standard error; with "did you mean" where a
// command, an option or a setting is a slip of the pen away. Ends with a line feed.
[[nodiscard]] std::string text_of_wrong_call(const CLI::App& app, const CLI::ParseError& fault);

}  // namespace trc::cli
