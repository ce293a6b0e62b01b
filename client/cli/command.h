#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace trc::cli {

// How the program ends; scripts rely on these numbers.
enum class Exit : int {
  done = 0,
  refused = 1,      // the program cannot be compensated as it is, or its path gouges
  wrong_call = 2,   // a flag, a file or a setting
  unreachable = 3,  // the server cannot be reached, or was lost
  limit = 4,        // a limit of the server or of this machine was met; the program may be good
  internal = 5,     // the service or this program has a fault
};

// What the command line asked for; set by the subcommand that was named.
using Action = std::function<Exit()>;

// One file each.
void add_compensate(CLI::App& app, Action& action);
void add_plot(CLI::App& app, Action& action);
void add_radii(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_generate(CLI::App& app, Action& action);
void add_load(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_health(CLI::App& app, Action& action);

}  // namespace trc::cli
