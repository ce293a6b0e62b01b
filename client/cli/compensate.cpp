#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/progress.h"
#include "client/cli/service.h"
#include "core/nc/state/program_state.h"
#include "core/trc/result/listing.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/json_lines.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::string format = "nc";
  std::string output;
  std::uint32_t decimals = 4;
  bool force = false;
};

// The program a path came from is worth more than the path.
bool may_write(const Call& call) {
  if (call.force || call.output.empty() || !is_same_file(call.program.file, call.output))
    return true;
  std::cerr << "trc: -o " << call.output
            << " is the program itself; write another file, or say --force\n";
  return false;
}

// Path items as the lines of --format jsonl.
class JsonWriter {
 public:
  std::string lines_for(const Answer& answer) {
    std::string text;
    for (const CompensatedBlock& block : answer.blocks) {
      wire::to_proto(block, *item_.mutable_block());
      lines_.append(item_, text);
    }
    for (const wire::ReceivedDiagnostic& received : answer.diagnostics) {
      v1::Diagnostic& message = *item_.mutable_diagnostic();
      wire::to_proto(received.diagnostic, message);
      message.set_message(received.message);
      message.set_remedy(received.remedy);
      message.set_reason(received.reason);
      lines_.append(item_, text);
    }
    return text;
  }

  std::string line_for(const wire::PathSummary& summary) {
    std::string text;
    wire::to_proto(summary, *item_.mutable_summary());
    lines_.append(item_, text);
    return text;
  }

 private:
  wire::JsonLines lines_;
  v1::PathItem item_;
};

std::vector<std::string> axis_names(const v1::ProgramSetup& setup) {
  const auto& names = setup.path().axis_names();
  if (names.empty()) return ProgramSetup{}.tracking_axes;
  return {names.begin(), names.end()};
}

Exit run(const Call& call) {
  v1::ProgramSetup setup;
  if (!setup_of(call.program, setup)) return Exit::wrong_call;
  const bool as_nc = call.format == "nc";
  const bool as_json = call.format == "jsonl";
  setup.set_output(as_nc ? v1::PROGRAM_OUTPUT_NC : v1::PROGRAM_OUTPUT_BLOCKS);
  setup.set_decimals(call.decimals);
  if (!may_write(call)) return Exit::wrong_call;

  Input input(call.program.file);
  Output output(call.output, as_nc ? Output::OnScreen::with_commit : Output::OnScreen::at_once);
  if (!input.open() || !output.open()) return Exit::wrong_call;
  Progress progress(output.is_standard_output());
  JsonWriter json;
  const std::vector<std::string> axes = axis_names(setup);

  const Outcome outcome =
      compensate_program(call.program.service, setup, input, progress, [&](const Answer& answer) {
        if (as_nc) return output.write(answer.text);
        if (as_json) return output.write(json.lines_for(answer));
        std::string text;
        for (const CompensatedBlock& block : answer.blocks) {
          append_listing(text, block, axes, static_cast<int>(call.decimals));
          text += '\n';
        }
        return output.write(text);
      });
  if (as_json && outcome.summary && !output.write(json.line_for(outcome.summary->path)))
    return Exit::wrong_call;
  // Half a program must not look like a whole one. Listings and JSON lines of what was certain
  // before a refusal are shown on the screen: no control runs them.
  const bool keep = outcome.exit == Exit::done || (output.is_standard_output() && !as_nc);
  if (keep && !output.commit()) return Exit::wrong_call;
  return outcome.exit;
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
                      "File to write, else standard output. An NC program appears there, too, only "
                      "when all of it was compensated");
  command->add_flag("--force", call->force, "Let -o replace the program itself");
  command->add_option("--decimals", call->decimals, "Decimal places of coordinates, 1 to 8")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command->footer(settings_help());
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
