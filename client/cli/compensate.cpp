#include <memory>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/job.h"
#include "client/cli/job_record.h"
#include "client/cli/program_options.h"
#include "client/cli/progress.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::string format = "nc";
  std::string output;
  std::uint32_t decimals = 4;
  std::string record;
};

Exit run(const Call& call) {
  v1::ProgramSetup setup;
  if (!setup_of(call.program, setup)) return Exit::wrong_call;
  report_clearance(setup);
  setup.set_decimals(call.decimals);

  Input input(call.program.file);
  Output output(call.output);
  Output record(call.record);
  if (!input.open() || !output.open()) return Exit::wrong_call;
  if (!call.record.empty() && !record.open()) return Exit::wrong_call;
  Progress progress(output.is_standard_output());
  Job job{.service = call.program.service,
          .setup = setup,
          .format = call.format,
          .input_name = call.program.file,
          .output_name = call.output.empty() ? "-" : call.output,
          .recorded = !call.record.empty()};
  const Exit exit =
      do_job(job, input, progress, [&](const std::string& text) { return output.write(text); });
  // What was certain before a refusal is shown on the screen; a file of it could
  // be taken for a whole path.
  const bool keep = exit == Exit::done || output.is_standard_output();
  if (keep && !output.commit()) return Exit::wrong_call;
  if (call.record.empty() || (exit != Exit::done && exit != Exit::refused)) return exit;
  return record.write(text_of(job.record)) && record.commit() ? exit : Exit::wrong_call;
}

}  // namespace

void add_compensate(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "compensate", "Compensate an NC program: G41 and G42 resolved, G40 throughout");
  auto call = std::make_shared<Call>();
  add_program_options(*command, call->program);
  command
      ->add_option("--format", call->format,
                   "nc: NC program, jsonl: one JSON object per block, listing: one line per block")
      ->check(CLI::IsMember({"nc", "jsonl", "listing"}))
      ->capture_default_str();
  command->add_option("-o,--output", call->output,
                      "File to write; it appears only when all went well. Else standard output");
  command->add_option("--decimals", call->decimals, "Decimal places of coordinates, 1 to 8")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command
      ->add_option("--record", call->record,
                   "File to write a record of the job to: what was made of which bytes with which "
                   "settings, and how it was measured. trc verify --record checks it")
      ->type_name("FILE.json");
  command->footer(
      "The path is measured against the contour on its way (verify=report): where it comes nearer "
      "than the tool\nradius, warning 900216 says where. verify=enforce refuses such a program, "
      "verify=off measures nothing.\n\n" +
      settings_help());
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
