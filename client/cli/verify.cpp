#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/program_paths.h"
#include "core/base/tolerances.h"
#include "core/nc/text/number_format.h"
#include "core/verify/clearance.h"

namespace trc::cli {
namespace {

std::string mm(double value) {
  std::string text;
  append_fixed(text, value, 4);
  return text;
}

std::string percent(double share) {
  std::string text;
  append_fixed(text, 100 * share, 1);
  return text + " %";
}

std::string block_name(const Source& source) {
  std::string name =
      source.number == Source::no_number ? "" : "N" + std::to_string(source.number) + " ";
  return name + (name.empty() ? "line " : "(line ") + std::to_string(source.line) +
         (name.empty() ? "" : ")");
}

std::string worst_line(const verify::Clearance& worst) {
  return "smallest clearance " + mm(worst.distance) + " mm of " + mm(worst.required) + " mm at X" +
         mm(worst.place[0]) + " Y" + mm(worst.place[1]) + " Z" + mm(worst.place[2]) + ", path of " +
         block_name(worst.path) + " beside contour block " + block_name(worst.contour);
}

Exit run(const ProgramOptions& options) {
  v1::ProgramSetup setup;
  if (!setup_of(options, setup)) return Exit::wrong_call;
  Input input(options.file);
  if (!input.open()) return Exit::wrong_call;
  const ProgramPaths paths = read_paths(options.service, setup, input);
  if (paths.exit != Exit::done) return paths.exit;

  const double allowed = Tolerances{}.on_contour;
  const verify::ClearanceReport report =
      verify::measure_clearance(paths.programmed, paths.compensated, allowed, paths.leads);
  if (!report.worst) {
    std::cout << "nothing to verify: no compensated contour\n";
    return Exit::done;
  }
  std::cout << report.checked << " blocks of the path checked, " << worst_line(*report.worst)
            << '\n';
  if (report.wall_length > 0)
    std::cout << "the path touches " << percent(report.coverage()) << " of "
              << mm(report.wall_length) << " mm of wall\n";
  if (report.gouging == 0) return Exit::done;
  const Source& place = report.worst->path;
  std::cerr << input.name() << ':' << place.line << ": gouge: " << report.gouging
            << (report.gouging == 1 ? " block comes" : " blocks come")
            << " nearer to the contour than the tool radius, " << worst_line(*report.worst) << '\n';
  return Exit::refused;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "verify", "Measure how near the compensated path comes to the programmed contour");
  auto options = std::make_shared<ProgramOptions>();
  add_program_options(*command, *options);
  command->footer(
      "Every block between approach and retract is measured against every contour block of its "
      "selection,\nby a method of its own that knows nothing of how the path was made. Exit code 1 "
      "when the path comes\nnearer than the tool radius.\n\n" +
      settings_help());
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace trc::cli
