#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/service.h"

namespace trc::cli {
namespace {

Exit run(const ServiceOptions& options) {
  bool serving = false;
  const Exit exit = server_health(options, serving);
  if (exit != Exit::done) return exit;
  std::cout << (serving ? "serving\n" : "not serving\n");
  return serving ? Exit::done : Exit::refused;
}

}  // namespace

void add_health(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("health", "Ask a server whether it takes work");
  auto options = std::make_shared<ServiceOptions>();
  add_service_options(*command, *options);
  command->footer("Exit codes: 0 serving, 1 not serving (it is about to stop), 3 not reachable.");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace trc::cli
