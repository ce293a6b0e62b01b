#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/info_text.h"
#include "client/cli/printable.h"
#include "client/cli/program_info.h"
#include "client/cli/program_options.h"
#include "client/cli/service.h"
#include "client/cli/speech.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::string markdown;
};

// Describes the program in this process; it asks no server.
Exit describe_file(const Call& call) {
  v1::ProgramSetup message;
  if (!setup_of(call.program, message)) return Exit::wrong_call;
  wire::FieldFaults faults;
  const wire::ProgramSettings settings =
      wire::from_proto(message, wire::FieldPath("setup"), faults);
  for (const wire::FieldFault& fault : faults.listed())
    complain(fault.field + ": " + fault.description);
  Input input(call.program.file);
  if (!faults.empty() || !input.open()) return Exit::wrong_call;
  std::string text;
  for (std::string_view piece = input.read(); !piece.empty(); piece = input.read()) text += piece;
  if (input.failed()) return Exit::wrong_call;
  const ProgramInfo found = describe_program(text, {.session = settings.path.session});
  std::cout << printable(input.name()) << '\n' << found.text;
  return found.refused ? Exit::refused : Exit::done;
}

Exit run(const Call& call) {
  if (!call.program.file.empty()) return describe_file(call);
  v1::GetServerInfoResponse info;
  const Exit exit = server_info(call.program.service, info);
  if (exit != Exit::done) return exit;
  if (call.markdown == "options") {
    std::cout << markdown_options(info);
  } else if (call.markdown == "functions") {
    std::cout << markdown_functions(info);
  } else if (call.markdown == "diagnostics") {
    std::cout << markdown_diagnostics(info);
  } else if (call.markdown == "dialects") {
    std::cout << markdown_dialects();
  } else {
    std::cout << text_of(info, language_for(call.program.language));
  }
  return Exit::done;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("info",
                                     "Show version, limits, settings, #TRC options, G functions "
                                     "and diagnostics of the service; with a FILE: "
                                     "its dialect, its selections and what would be refused");
  auto call = std::make_shared<Call>();
  add_program_options(*command, call->program);
  command->get_option("file")->required(false);
  command
      ->add_option("--markdown", call->markdown,
                   "Print one table as Markdown, in English as the documentation has it")
      ->check(CLI::IsMember({"options", "functions", "diagnostics", "dialects"}));
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
