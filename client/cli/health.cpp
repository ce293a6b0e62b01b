#include <chrono>
#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/program_options.h"
#include "client/cli/service.h"
#include "client/cli/speech.h"

namespace trc::cli {
namespace {

struct Options {
  ServiceOptions service{};
  std::string language{};
  unsigned timeout_s = 3;
};

Exit run(const Options& options) {
  bool serving = false;
  const Exit exit =
      server_health(options.service, std::chrono::seconds(options.timeout_s), serving);
  if (exit != Exit::done) return exit;
  std::cout << told(serving ? "serving" : "not serving") << '\n';
  return serving ? Exit::done : Exit::refused;
}

}  // namespace

void add_health(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("health", "Ask a server whether it takes work");
  auto options = std::make_shared<Options>();
  add_service_options(*command, options->service);
  command->get_option("--server")->required()->description("Server to ask");
  // These options only apply to a run without a server.
  for (const char* name :
       {"--memory-limit-mib", "--max-session-memory-mib", "--max-blocks-per-selection"})
    command->remove_option(command->get_option(name));
  // Shorter than the timeout of container probes, so that the reason is still reported.
  command->add_option("--timeout-s", options->timeout_s, "How long to wait for the answer")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  add_language_option(*command, options->language);
  command->footer("Exit codes: 0 serving, 1 not serving (it is about to stop), 3 not reachable.");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace trc::cli
