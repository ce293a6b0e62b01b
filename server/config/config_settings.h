#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/config/config.h"

namespace trc::server {

// Each setting, with the value in TOML that it has at the time of the call.
struct PrintedSetting {
  std::string name{};
  std::function<std::string()> value{};
};
using Printed = std::vector<PrintedSetting>;

// Makes every setting an option of `app`, with its name in the environment, and appends it to
// `printed`. The three have to live as long as each other.
void declare(CLI::App& app, Config& config, Printed& printed);

// `drain-timeout-s` is TRCD_DRAIN_TIMEOUT_S in the environment.
[[nodiscard]] std::string environment_name(std::string_view setting);

// The names of all settings that were declared.
[[nodiscard]] std::vector<std::string> setting_names(const CLI::App& app);

// The settings that keep clients out: each has a value or is absent, never empty.
[[nodiscard]] const std::vector<std::string>& guard_names();
[[nodiscard]] bool is_guard(std::string_view setting);
// Whether it is empty or a list of nothing, as "$A,$B" where neither variable is set.
[[nodiscard]] bool is_empty_value(std::string_view value);

// The end of a sentence about a word that is none of the candidates: what was likely meant.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& candidates);

}  // namespace trc::server
