#include <unistd.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/folder_run.h"
#include "client/cli/job.h"
#include "client/cli/job_record.h"
#include "client/cli/printable.h"
#include "client/cli/program_options.h"
#include "client/cli/progress.h"
#include "client/cli/reporter.h"
#include "client/cli/result_text.h"
#include "client/cli/service.h"
#include "client/cli/speech.h"
#include "client/cli/summary_line.h"
#include "client/cli/verbose_text.h"
#include "client/cli/written_files.h"
#include "core/nc/convert/conversion.h"
#include "core/nc/dialect/dialect.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::vector<std::string> files;
  std::string directory;
  unsigned jobs = 1;
  std::string format = "nc";
  std::string output;
  std::optional<std::uint32_t> decimals{};  // nothing: as the program has them
  std::string record;
  std::string to;
  bool force = false;
  bool worker = false;  // for a folder
};

// False if the output would replace the program, which is worth more than its path.
bool may_write(const Call& call) {
  if (!call.force && is_same_file(call.program.file, call.output)) {
    complain("-o " + call.output + " is the program itself; write another file, or say --force");
    return false;
  }
  const WrittenFile output{.option = "-o", .path = call.output};
  const WrittenFile record{.option = "--record", .path = call.record};
  const FilesRead beside(call.program);
  FilesRead all = beside;
  all.add(call.program.file, "the program itself");
  return may_be_written({record}, all) &&
         may_be_written({output, record}, call.force ? beside : all);
}

bool setup_for(const Call& call, v1::ProgramSetup& setup) {
  if (!setup_of(call.program, setup)) return false;
  report_clearance(setup);
  if (call.decimals) setup.set_decimals(*call.decimals);
  return true;
}

// The words of the call that apply to every program.
std::vector<std::string> words_for_all(const CLI::App& command) {
  const std::set<std::string> own{"file",     "--output-dir", "--jobs", "--output",
                                  "--record", "--worker",     "--lang"};
  std::vector<std::string> words{"--lang", spoken_language() == Language::german ? "de" : "en"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->empty() || own.contains(name)) continue;
    for (const std::string& result : option->results()) {
      words.push_back(name);
      if (option->get_items_expected_max() > 0) words.push_back(result);
    }
  }
  return words;
}

Exit run_folder(const Call& call, const std::vector<std::string>& words) {
  FolderRun run{.files = call.files,
                .read = FilesRead(call.program),
                .directory = call.directory,
                .arguments = words,
                .format = call.format,
                .jobs = call.jobs,
                .quiet = call.program.loudness.quiet};
  if (!setup_for(call, run.setup)) return Exit::wrong_call;
  const ResultText asks_for_output(call.format, run.setup);
  v1::GetServerInfoResponse info;
  if (const Exit exit = server_info(call.program.service, info); exit != Exit::done) return exit;
  run.server_version = info.version();
  run.server_commit = info.commit();
  return compensate_folder(run);
}

// Writes the compensated program in the words of another dialect.
Exit write_converted(const Call& call, const v1::ProgramSetup& setup, const std::string& text,
                     Output& output) {
  wire::FieldFaults faults;
  const wire::ProgramSettings read = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  const ConvertedProgram converted =
      convert_program(text, read.path.session.program, *dialect_spelled(call.to));
  for (const ConvertedProgram::Fault& fault : converted.faults)
    std::cerr << told(printable(call.program.file) + ": error: --to " + call.to +
                      " does not convert " + fault.word + " (line " + std::to_string(fault.line) +
                      " of the compensated program)")
              << '\n';
  if (!converted.faults.empty()) return Exit::refused;
  return output.write(converted.text) && output.commit() ? Exit::done : Exit::wrong_call;
}

// A word that selects nothing, such as G141 in place of G41, leaves the program as it is.
void tell_where_nothing_is_compensated(const Call& call, const Job& job, const Input& input) {
  if (!job.summary || call.program.loudness.quiet || !compensates_nothing(job.summary->path))
    return;
  std::cerr << told(input.name() +
                    ": warning: nothing is compensated: no G41, G42 (RL, RR) with a radius")
            << '\n';
}

// Writes the summary to standard error, after all output: for a user at a terminal, or on request.
void tell_done(const Call& call, const Job& job, const Input& input, double seconds) {
  const Loudness& loudness = call.program.loudness;
  if (!job.summary || loudness.quiet) return;
  if (!loudness.verbose && isatty(STDERR_FILENO) != 1) return;
  const bool inch = counts_in_inch(call.program, job.setup);
  const Telling telling{.language = language_of(job.setup),
                        .unit = inch ? LengthUnit::inch : LengthUnit::mm};
  if (loudness.verbose) std::cerr << text_of_done(input.name(), *job.summary, seconds, telling);
  std::cerr << summary_line(job.summary->path, telling.unit, seconds, telling.language) << '\n';
}

Exit run(const Call& call) {
  v1::ProgramSetup setup;
  if (!setup_for(call, setup)) return Exit::wrong_call;

  if (!may_write(call)) return Exit::wrong_call;
  const bool as_nc = call.format == "nc";
  if (!as_nc && !call.to.empty()) {
    complain("--to writes an NC program: leave out --format " + call.format);
    return Exit::wrong_call;
  }

  Input input(call.program.file);
  const Output::Disk disk = call.worker ? Output::Disk::asked_by_others : Output::Disk::asked;
  Output output(call.output, as_nc ? Output::OnScreen::with_commit : Output::OnScreen::at_once,
                disk);
  if (!input.open() || !output.open()) return Exit::wrong_call;
  const Loudness& loudness = call.program.loudness;
  if (loudness.verbose)
    if (const Exit exit = tell_taken(input.name(), setup, call.program.service); exit != Exit::done)
      return exit;
  const auto began = std::chrono::steady_clock::now();
  const auto result = output.is_standard_output() && !as_nc ? Progress::Result::on_screen
                                                            : Progress::Result::elsewhere;
  Progress progress(result, loudness, language_of(setup));
  Reporter reporter(input, setup, progress, loudness.quiet);
  Job job{.service = call.program.service,
          .setup = setup,
          .format = call.format,
          .input_name = call.program.file,
          .output_name = call.output.empty() ? "-" : call.output,
          .recorded = !call.record.empty()};
  std::string whole;
  const Exit exit = do_job(job, input, reporter, [&](const std::string& text) {
    if (call.to.empty()) return output.write(text);
    whole += text;
    return true;
  });
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (!call.to.empty()) {
    const Exit written = exit == Exit::done ? write_converted(call, setup, whole, output) : exit;
    if (written == Exit::done) tell_where_nothing_is_compensated(call, job, input);
    if (written == Exit::done) tell_done(call, job, input, seconds);
    return written;
  }
  // A partial program must not look like a whole one. On the screen, listings and JSON lines from
  // before a refusal remain: no control runs them.
  const bool keep = exit == Exit::done || (output.is_standard_output() && !as_nc);
  if (keep && !output.commit()) return Exit::wrong_call;
  tell_where_nothing_is_compensated(call, job, input);
  tell_done(call, job, input, seconds);
  if (call.record.empty() || (exit != Exit::done && exit != Exit::refused)) return exit;
  Output record(call.record, Output::OnScreen::at_once, disk);
  return record.open() && record.write(text_of(job.record)) && record.commit() ? exit
                                                                               : Exit::wrong_call;
}

Exit work(const Call& call) {
  const auto kept = keep_service();
  return work_for_folder([&](const std::string& file) {
    Call one = call;
    one.program.service.kept = kept;
    one.program.file = file;
    one.output = result_in(call.directory, file);
    one.record = record_in(call.directory, file);
    return run(one);
  });
}

void add_output_options(CLI::App& command, Call& call) {
  command
      .add_option("--format", call.format,
                  "nc: NC program, jsonl: one JSON object per block, listing: one line per block")
      ->check(CLI::IsMember({"nc", "jsonl", "listing"}))
      ->capture_default_str();
  command.add_option("-o,--output", call.output,
                     "File to write, else standard output. An NC program appears there, too, only "
                     "when all of it was compensated");
  command.add_flag("--force", call.force, "Let -o replace the program itself");
  command
      .add_option(
          "--decimals", call.decimals,
          "Decimal places of coordinates, 1 to 8; in an NC program 4, or those of the program "
          "where it has more")
      ->check(CLI::Range(1, 8));
}

// Returns the option that names the folder.
CLI::Option* add_folder_options(CLI::App& command, Call& call) {
  auto* directory =
      command
          .add_option("--output-dir", call.directory,
                      "Directory for the results of all programs, under their names, and a "
                      "record of each. What has not changed since is left out")
          ->type_name("DIR")
          ->excludes("--output");
  command.add_option("--jobs", call.jobs, "Programs at a time, with --output-dir")
      ->check(CLI::Range(1, 256))
      ->capture_default_str()
      ->needs(directory);
  // Hidden: --output-dir starts its worker processes with it.
  command.add_flag("--worker", call.worker)->group("")->needs(directory);
  command
      .add_option("--record", call.record,
                  "File to write a record of the job to: what was made of which bytes with which "
                  "settings, and how it was measured. trc verify --record checks it")
      ->type_name("FILE.json")
      ->excludes(directory);
  std::vector<std::string> dialects;
  for (const Dialect& dialect : all_dialects()) dialects.emplace_back(dialect.spelling);
  command
      .add_option("--to", call.to,
                  "Dialect to write: motions, feeds, M, S and T in its words, absolute and in mm. "
                  "A program that says more is refused by the word")
      ->transform(CLI::IsMember(dialects, CLI::ignore_case))
      ->excludes(directory)
      ->excludes("--record");
  return directory;
}

}  // namespace

void add_compensate(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "compensate", "Compensate an NC program: G41 and G42 resolved, G40 throughout");
  auto call = std::make_shared<Call>();
  auto* files =
      command->add_option("file", call->files, "NC program, or several; - reads standard input");
  files->type_name("FILE")->required();
  add_setup_options(*command, call->program);
  add_loudness_options(*command, call->program.loudness);
  add_output_options(*command, *call);
  auto* directory = add_folder_options(*command, *call);
  command->footer(
      "The path is measured against the contour on its way (verify=report): where it comes nearer "
      "than the tool\nradius, warning 900216 says where. verify=enforce refuses such a program, "
      "verify=off measures nothing.\n\n" +
      settings_help(Language::english));
  command->callback([call, command, directory, &action] {
    if (call->worker) {
      action = [call] { return work(*call); };
      return;
    }
    if (!directory->empty()) {
      action = [call, words = words_for_all(*command)] { return run_folder(*call, words); };
      return;
    }
    if (call->files.size() > 1)
      throw CLI::ValidationError("FILE",
                                 "several programs need --output-dir, where their results go");
    call->program.file = call->files.front();
    action = [call] { return run(*call); };
  });
}

}  // namespace trc::cli
