#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/program_paths.h"
#include "client/cli/reporter.h"
#include "client/cli/speech.h"
#include "client/cli/standalone_page.h"
#include "client/cli/written_files.h"
#include "client/plot/picture.h"
#include "client/plot/svg.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/path_item.h"
#include "proto/wire/setup.h"
#include "server/http/view/view_builder.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::string output;
  std::string format;  // empty: from the ending of `output`
  bool numbers = false;
  bool points = false;
};

// The page that shows this program; none: it is too large, as standard error says.
std::optional<std::string> page_of(std::string text, const v1::ProgramSetup& setup,
                                   const std::string& name, const ProgramPaths& paths) {
  const std::size_t blocks = paths.programmed.size() + paths.compensated.size();
  if (blocks > most_page_blocks) {
    complain(name + " has " + std::to_string(blocks) +
             " blocks of contour and path, a page holds " + std::to_string(most_page_blocks) +
             "; use trc view, or write .svg");
    return std::nullopt;
  }
  wire::FieldFaults faults;
  wire::ProgramSettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  server::http::Memory memory(std::numeric_limits<std::size_t>::max() / 2);
  server::http::ViewBuilder builder({.text = std::make_shared<const std::string>(std::move(text)),
                                     .name = name,
                                     .settings = std::move(settings)},
                                    memory, [] { return false; });
  if (paths.exit == Exit::refused) builder.set_refused();
  for (const Diagnostic& diagnostic : paths.diagnostics) {
    v1::Diagnostic message;
    wire::to_proto(diagnostic, message);
    builder.add(message);
  }
  if (paths.summary) {
    v1::ProgramSummary summary;
    wire::to_proto(*paths.summary, summary);
    builder.set_summary(summary);
  }
  builder.take_contour(paths.programmed);
  builder.take_path(paths.compensated);
  const auto view = builder.finish("inside", {});
  if (view == nullptr) return std::nullopt;
  if (paths.exit == Exit::done) view->make_output([] {}, {});
  return standalone_page(*view, setup.path().language());
}

Exit run(const Call& call) {
  v1::ProgramSetup setup;
  if (!setup_of(call.program, setup)) return Exit::wrong_call;
  report_clearance(setup);
  const std::string ending = std::filesystem::path(call.output).extension().string();
  const bool as_page =
      call.format.empty() ? ending == ".html" || ending == ".htm" : call.format == "html";
  if (call.format.empty() && !as_page && ending != ".svg" && call.output != "-") {
    complain("-o " + call.output +
             ": the name must end in .svg or .html, or --format must say which it is");
    return Exit::wrong_call;
  }
  FilesRead read(call.program);
  read.add(call.program.file, "the program itself");
  if (!may_be_written({{.option = "-o", .path = call.output}}, read)) return Exit::wrong_call;
  Input input(call.program.file);
  Output output(call.output);
  if (!input.open() || !output.open()) return Exit::wrong_call;

  std::string text;
  if (as_page) input.watch([&](std::string_view piece) { text += piece; });
  ProgramPaths paths = read_paths(call.program, setup, input);
  if (paths.exit != Exit::done && paths.exit != Exit::refused) return paths.exit;
  const DialectName dialect = dialect_of(setup);
  for (Diagnostic& found : paths.diagnostics) found = for_command_line(std::move(found), dialect);
  const std::string title = std::filesystem::path(input.name()).filename().string();
  std::optional<std::string> drawing;
  if (as_page)
    drawing = page_of(std::move(text), setup, title, paths);
  else
    drawing = plot::to_svg(
        plot::compose_views(
            {.title = title,
             .programmed = paths.programmed,
             .path = paths.compensated,
             .diagnostics = paths.diagnostics,
             .language = language_of_tag(setup.path().language()).value_or(Language::english),
             .inch = paths.inch,
             .leads = paths.leads,
             .start = paths.start}),
        {.numbers = call.numbers, .points = call.points});
  if (!drawing || !output.write(*drawing) || !output.commit()) return Exit::wrong_call;
  return paths.exit;
}

}  // namespace

void add_plot(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "plot", "Draw the programmed contour (black) and the compensated path (blue)");
  auto call = std::make_shared<Call>();
  add_program_options(*command, call->program);
  add_loudness_options(*command, call->program.loudness);
  command->add_option("-o,--output", call->output, "Picture to write, .svg or .html; - is SVG")
      ->type_name("OUT.svg|OUT.html")
      ->required();
  command
      ->add_option(
          "--format", call->format,
          "svg, a picture, or html, a page that needs no server, of at most 250000 blocks; "
          "by default the ending of the name says it")
      ->type_name("svg|html")
      ->check(CLI::IsMember({"svg", "html"}));
  command->add_flag("--numbers", call->numbers, "Write block numbers beside the contour (svg)");
  command->add_flag("--points", call->points, "Mark where the blocks end (svg)");
  command->footer(
      "Leads, approach and retract are thin, rapid moves dashed, masked or removed blocks red, "
      "transition blocks light "
      "blue; red\nand dashed is what was programmed where another contour is compensated "
      "(CONV_CIR_TO_LIN,\nKERF_MASKING). Warnings are yellow at their place. Where the radius "
      "changes "
      "both tools are drawn.\nOther planes that are compensated have views of their own; where the "
      "third axis moves there is one from the side.\n"
      "Where the measured path comes nearer to the contour than the tool radius, warning 900216 "
      "says\n"
      "where. A refused program gives the picture of what was certain, with the place marked, and "
      "exit "
      "code 1;\nwhat is proposed in place of an approach or a retract is green and dashed.\n"
      "An .html file is the page of trc view with the program inside: contour, path, listings and "
      "what\nwas found. It opens from the disk, loads nothing and holds at most 250000 blocks of "
      "contour and path.\n\n" +
      settings_help(Language::english));
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
