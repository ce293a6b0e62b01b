#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/config/config.h"

namespace trc::server {

// Each setting as a line of TOML, with the value that it has at the time of the call.
using Printed = std::vector<std::function<std::string()>>;

// Makes every setting an option of `app`, with its name in the environment, and appends it to
// `printed`. The three have to live as long as each other.
void declare(CLI::App& app, Config& config, Printed& printed);

// `drain-timeout-s` is TRCD_DRAIN_TIMEOUT_S in the environment.
[[nodiscard]] std::string environment_name(std::string_view setting);

// Of all settings that were declared.
[[nodiscard]] std::vector<std::string> setting_names(const CLI::App& app);

// To end a sentence about a word that is none of the candidates: what was likely meant.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& candidates);

}  // namespace trc::server
