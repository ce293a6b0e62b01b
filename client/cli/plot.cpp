#include <filesystem>
#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/program_paths.h"
#include "client/plot/html.h"
#include "client/plot/picture.h"
#include "client/plot/svg.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::string output;
  bool numbers = false;
};

Exit run(const Call& call) {
  v1::ProgramSetup setup;
  if (!setup_of(call.program, setup)) return Exit::wrong_call;
  report_clearance(setup);
  const std::string ending = std::filesystem::path(call.output).extension().string();
  const bool as_page = ending == ".html" || ending == ".htm";
  if (!as_page && ending != ".svg" && call.output != "-") {
    std::cerr << "trc: -o " << call.output << ": the name must end in .svg or .html\n";
    return Exit::wrong_call;
  }
  if (is_same_file(call.program.file, call.output)) {
    std::cerr << "trc: -o " << call.output << " is the program itself; write another file\n";
    return Exit::wrong_call;
  }
  Input input(call.program.file);
  Output output(call.output);
  if (!input.open() || !output.open()) return Exit::wrong_call;

  const ProgramPaths paths = read_paths(call.program.service, setup, input);
  if (paths.exit != Exit::done && paths.exit != Exit::refused) return paths.exit;
  const plot::Picture picture =
      plot::compose({.title = std::filesystem::path(input.name()).filename().string(),
                     .programmed = paths.programmed,
                     .path = paths.compensated,
                     .diagnostics = paths.diagnostics,
                     .leads = paths.leads});
  const std::string drawing = as_page ? plot::to_html(picture, call.numbers)
                                      : plot::to_svg(picture, {.numbers = call.numbers});
  if (!output.write(drawing) || !output.commit()) return Exit::wrong_call;
  return paths.exit;
}

}  // namespace

void add_plot(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "plot", "Draw the programmed contour (black) and the compensated path (blue)");
  auto call = std::make_shared<Call>();
  add_program_options(*command, call->program);
  command->add_option("-o,--output", call->output, "Picture to write, .svg or .html; - is SVG")
      ->type_name("OUT.svg|OUT.html")
      ->required();
  command->add_flag("--numbers", call->numbers, "Write block numbers beside the contour");
  command->footer(
      "Leads are thin, rapid moves dashed, masked or removed blocks red, transition blocks light "
      "blue; red\nand dashed is what was programmed where another contour is compensated "
      "(CONV_CIR_TO_LIN,\nKERF_MASKING). Warnings are yellow at their place.\n"
      "Where the measured path comes nearer to the contour than the tool radius, warning 900216 "
      "says\n"
      "where. A refused program gives the picture of what was certain, with the place marked, and "
      "exit "
      "code 1;\nwhat is proposed in place of an approach or a retract is green and dashed.\n\n" +
      settings_help());
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
