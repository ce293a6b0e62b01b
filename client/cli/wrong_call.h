#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace trc::cli {

// The fault of a call that cannot be parsed, for standard error; with "did you mean" where a
// command, an option or a setting is a slip of the pen away. Ends with a line feed.
[[nodiscard]] std::string text_of_wrong_call(const CLI::App& app, const CLI::ParseError& fault);

// In the same form, the fault of a value that the parser accepts: one that is empty, or a number in
// hexadecimal or octal form. Empty: there is none.
[[nodiscard]] std::string text_of_wrong_value(const CLI::App& command);

// What stands in the environment for TRC_SERVER by a slip of the pen, where the command asks a
// server and none is given: somebody believes that one to be asked. Empty: nothing does.
[[nodiscard]] std::string note_on_environment(const CLI::App& command);

}  // namespace trc::cli
