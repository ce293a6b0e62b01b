#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/info_text.h"
#include "client/cli/service.h"

namespace trc::cli {
namespace {

struct Call {
  ServiceOptions service;
  std::string markdown;
};

Exit run(const Call& call) {
  v1::GetServerInfoResponse info;
  const Exit exit = server_info(call.service, info);
  if (exit != Exit::done) return exit;
  if (call.markdown == "options") {
    std::cout << markdown_options(info);
  } else if (call.markdown == "functions") {
    std::cout << markdown_functions(info);
  } else if (call.markdown == "diagnostics") {
    std::cout << markdown_diagnostics(info);
  } else {
    std::cout << text_of(info);
  }
  return Exit::done;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "info", "Show version, limits, #TRC options, G functions and diagnostics of the service");
  auto call = std::make_shared<Call>();
  add_service_options(*command, call->service);
  command->add_option("--markdown", call->markdown, "Print one table as Markdown")
      ->check(CLI::IsMember({"options", "functions", "diagnostics"}));
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
