#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>
#include <utility>

#include "client/cli/command.h"
#include "client/cli/file_name.h"
#include "client/cli/files.h"
#include "client/cli/fixed_text.h"
#include "client/cli/job.h"
#include "client/cli/job_record.h"
#include "client/cli/printable.h"
#include "client/cli/program_options.h"
#include "client/cli/program_paths.h"
#include "client/cli/progress.h"
#include "client/cli/reporter.h"
#include "client/cli/speech.h"
#include "client/cli/untouched_walls.h"
#include "client/cli/verbose_text.h"
#include "core/base/length_unit.h"
#include "core/base/tolerances.h"
#include "core/verify/clearance.h"

namespace trc::cli {
namespace {

std::string percent(double share) { return fixed(100 * share, 1) + " %"; }

std::string block_name(const Source& source) {
  std::string name =
      source.number == Source::no_number ? "" : "N" + std::to_string(source.number) + " ";
  return name + (name.empty() ? "line " : "(line ") + std::to_string(source.line) +
         (name.empty() ? "" : ")");
}

// Lengths in the unit that the program counts in (D-46).
class VerifyText {
 public:
  explicit VerifyText(LengthUnit unit) : unit_(unit) {}

  [[nodiscard]] std::string worst_line(const verify::Clearance& worst) const {
    return "smallest clearance " + with_unit(worst.distance) + " of " + with_unit(worst.required) +
           " at X" + length(worst.place[0]) + " Y" + length(worst.place[1]) + " Z" +
           length(worst.place[2]) + ", path of " + block_name(worst.path) +
           " beside contour block " + block_name(worst.contour);
  }
  // Prints how much of the walls the path touches, and why the rest is not touched.
  void print_coverage(const verify::ClearanceReport& report, const UntouchedWalls& untouched) const;

 private:
  [[nodiscard]] std::string length(double mm) const { return length_in(unit_, mm, 4); }
  [[nodiscard]] std::string with_unit(double mm) const { return length(mm) + name_of_unit(unit_); }
  void print_share(const UntouchedWalls::Share& share, const char* what) const;

  LengthUnit unit_;
};

void VerifyText::print_share(const UntouchedWalls::Share& share, const char* what) const {
  if (share.stretches == 0) return;
  std::cout << told("  " + with_unit(share.length) + " " + what + ": " +
                    std::to_string(share.stretches) +
                    (share.stretches == 1 ? " stretch" : " stretches") + ", the longest " +
                    with_unit(share.longest) + " of " + block_name(share.longest_at))
            << '\n';
}

void VerifyText::print_coverage(const verify::ClearanceReport& report,
                                const UntouchedWalls& untouched) const {
  if (report.wall_length <= 0) return;
  using Reason = UntouchedWalls::Reason;
  std::cout << told("the path touches " + percent(report.coverage()) + " of " +
                    with_unit(report.wall_length) + " of wall")
            << '\n';
  print_share(untouched.of(Reason::inside_corner),
              "lie in inside corners, into which a round tool does not reach");
  print_share(untouched.of(Reason::left_out),
              "are left out or passed by, as the tool has no room there");
  print_share(untouched.of(Reason::farther_away),
              "have the path farther away than the tool radius");
}

struct Call {
  ProgramOptions program;
  std::string record;
};

// How the output file differs from its record; empty: it does not. A refused program may have left
// no file, or an older one. A missing file is only reported.
std::string fault_of_output(const v1::JobRecord& filed, const std::string& record) {
  if (filed.output().name().empty() || filed.output().name() == "-" || filed.outcome() != "DONE")
    return {};
  const std::string path = file_of_record(filed.output(), record);
  std::error_code missing;
  if (!std::filesystem::exists(path, missing)) {
    std::cout << told(printable(filed.output().name()) +
                      " is not here: only the bytes made anew were compared")
              << '\n';
    return {};
  }
  // A device keeps no output.
  if (!std::filesystem::is_regular_file(path) || is_output_of(filed, path)) return {};
  return text_of_name(path) + " does not hold what came out when this record was made";
}

// Reports a fault. Exit::refused: a record, but changed so that it cannot be used.
Exit read_record(const std::string& name, std::string& text, v1::JobRecord& filed) {
  Input file(name);
  if (!file.open()) return Exit::wrong_call;
  for (std::string_view piece = file.read(); !piece.empty(); piece = file.read()) text += piece;
  if (file.failed()) return Exit::wrong_call;
  const std::string fault = record_from(text, filed);
  if (fault.empty()) return Exit::done;
  complain(name + ": " + fault);
  return is_record(text) ? Exit::refused : Exit::wrong_call;
}

// Opens the program; if it cannot, and none was given, says how to name one.
bool open_program(const Call& call, Input& input) {
  if (input.open()) return true;
  if (call.program.file.empty())
    complain("name the program: trc verify --record " + call.record + " FILE");
  return false;
}

// Does the job again. Reports differences in the result, and in the file written then.
Exit check_record(const Call& call) {
  std::string text;
  v1::JobRecord filed;
  if (const Exit exit = read_record(call.record, text, filed); exit != Exit::done) return exit;
  // Reported first, because the names in the record may have been changed, too.
  const std::string changed = fault_of_seal(text, filed);
  if (!changed.empty()) complain(call.record + ": " + changed);
  const std::string name =
      call.program.file.empty() ? file_of_record(filed.input(), call.record) : call.program.file;
  Input input(name);
  if (!open_program(call, input)) return Exit::wrong_call;
  Job job{.service = call.program.service,
          .setup = filed.setup(),
          .format = filed.output_format(),
          .input_name = name,
          .recorded = true};
  const Loudness& loudness = call.program.loudness;
  if (loudness.verbose)
    if (const Exit exit = tell_taken(input.name(), job.setup, job.service); exit != Exit::done)
      return exit;
  Progress progress(Progress::Result::elsewhere, loudness, language_of(job.setup));
  Reporter reporter(input, job.setup, progress, loudness.quiet);
  const Exit exit = do_job(job, input, reporter, [](const std::string&) { return true; });
  if (exit != Exit::done && exit != Exit::refused) return exit;
  std::vector<std::string> found = differences(filed, job.record);
  if (std::string fault = fault_of_output(filed, call.record); !fault.empty())
    found.push_back(std::move(fault));
  for (const std::string& sentence : found) complain(call.record + ": " + sentence);
  const bool same_version = filed.server_version() == job.record.server_version() &&
                            filed.server_commit() == job.record.server_commit();
  if (!same_version)
    complain(call.record + ": it was made by version " + filed.server_version() + " (" +
             filed.server_commit() + "), this is " + job.record.server_version() + " (" +
             job.record.server_commit() + ")");
  if (!found.empty() || !changed.empty()) return Exit::refused;
  std::cout << told("the record holds: " + std::to_string(filed.output().bytes()) +
                    " bytes, SHA-256 " + filed.output().sha256() + ", " + filed.outcome())
            << '\n';
  return Exit::done;
}

Exit run(const ProgramOptions& options) {
  v1::ProgramSetup setup;
  if (!setup_of(options, setup)) return Exit::wrong_call;
  Input input(options.file);
  if (!input.open()) return Exit::wrong_call;
  const ProgramPaths paths = read_paths(options, setup, input);
  if (paths.exit != Exit::done) return paths.exit;

  const double allowed = Tolerances{}.on_contour;
  Progress progress(Progress::Result::elsewhere, options.loudness, language_of(setup));
  UntouchedWalls untouched(paths.programmed, paths.compensated);
  const verify::ClearanceReport report = verify::measure_clearance(
      paths.programmed, paths.compensated,
      {.allowed = allowed,
       .leads = paths.leads,
       .uncut = [&](const verify::UncutWall& wall) { untouched.add(wall); },
       .progress = [&](std::size_t done, std::size_t all) { progress.measured(done, all); }});
  progress.clear();
  if (!report.worst) {
    std::cout << told("nothing to verify: no compensated contour") << '\n';
    return Exit::done;
  }
  const VerifyText text(paths.inch ? LengthUnit::inch : LengthUnit::mm);
  std::cout << told(std::to_string(report.checked) + " blocks of the path checked, " +
                    text.worst_line(*report.worst))
            << '\n';
  if (report.worst->margin() < -allowed &&
      (!report.gouge ||
       report.worst->margin() < report.gouge->margin() - verify::margin_resolution))
    std::cout << told("the contour closes there: that is a touch, no gouge") << '\n';
  text.print_coverage(report, untouched);
  for (const verify::CrossedWall& crossed : report.crossed)
    std::cerr << told(printable(input.name()) + ':' + std::to_string(crossed.way.line) +
                      ": the approach or the retract leads through the contour at line " +
                      std::to_string(crossed.wall.line))
              << '\n';
  if (report.gouging == 0) return report.crossed.empty() ? Exit::done : Exit::refused;
  const verify::Clearance& gouge = *report.gouge;
  std::cerr << told(printable(input.name()) + ':' + std::to_string(gouge.path.line) +
                    ": gouge: " + std::to_string(report.gouging) +
                    (report.gouging == 1 ? " block comes" : " blocks come") +
                    " nearer to the contour than the tool radius, " + text.worst_line(gouge))
            << '\n';
  return Exit::refused;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "verify", "Measure how near the compensated path comes to the programmed contour");
  auto call = std::make_shared<Call>();
  add_program_options(*command, call->program);
  add_loudness_options(*command, call->program.loudness);
  auto* record =
      command
          ->add_option("--record", call->record,
                       "Do the job of this record again and say whether the same comes out, and "
                       "whether the file written then still holds it; without FILE of the "
                       "program it names")
          ->type_name("FILE.json")
          ->excludes("--set");
  auto* file = command->get_option("file");
  file->required(false);
  command->footer(
      "Every block between approach and retract is measured against every contour block of its "
      "selection,\nby a method of its own that knows nothing of how the path was made. Exit code 1 "
      "when the path comes\nnearer than the tool radius, or when an approach or a retract leads "
      "through the contour.\n\n" +
      settings_help(Language::english));
  command->callback([call, record, file, &action] {
    if (file->empty() && record->empty()) throw CLI::RequiredError("FILE or --record");
    action = [call] { return call->record.empty() ? run(call->program) : check_record(*call); };
  });
}

}  // namespace trc::cli
