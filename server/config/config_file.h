#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace trc::server {

// Lets a TOML or a YAML library, by the name of the file, read the file of `app`, and drops
// settings that the environment overrides. Errors (CLI::ConfigError) name file and line.
[[nodiscard]] std::shared_ptr<CLI::Config> config_file(const CLI::App& app);

}  // namespace trc::server
