#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string_view>

namespace trc::cli {

// The German of the description of a command, an option or a line below them. Nothing: it has no
// row.
[[nodiscard]] std::optional<std::string_view> german_help_of(std::string_view english);

// From here on the help of `app` and of its commands is German. Names, values and what they are
// checked for stay as they are.
void speak_german(CLI::App& app);

}  // namespace trc::cli
