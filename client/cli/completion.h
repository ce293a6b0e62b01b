#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "client/cli/command.h"

namespace trc::cli {

// A script that completes words of the command line in a shell, made from the commands and options
// of `app` and their descriptions. `shell`: bash, zsh or fish.
[[nodiscard]] std::string completion_for(const CLI::App& app, const std::string& shell);

// The subcommand that prints it.
void add_completion(CLI::App& app, Action& action);

}  // namespace trc::cli
