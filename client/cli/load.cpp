#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/cli/command.h"
#include "client/cli/program_options.h"
#include "client/cli/service.h"
#include "client/cli/speech.h"
#include "client/load/generator.h"
#include "client/load/load_report.h"
#include "client/load/process_meter.h"
#include "proto/wire/settings.h"

namespace trc::cli {
namespace {

struct Call {
  ServiceOptions service;
  std::string language;
  std::vector<std::string> assignments;
  load::ShapeRequest shape{.shape = "random", .blocks = 1000};
  load::Plan plan;
  load::Layout layout = load::Layout::columns;
  std::uint32_t batch = 256;
  std::uint64_t connections = 0;
  double ramp_s = 0;
  double duration_s = 10;
  double verify = 0.02;
  std::uint32_t window = 0;
  bool closed = false;
  bool masking = false;
  bool json = false;
};

// Servers admit a few dozen streams to one connection.
constexpr std::uint64_t streams_per_connection = 50;
constexpr std::chrono::seconds grace_of_open_loop{10};

std::atomic<bool> interrupted{false};

// The first interrupt ends the run with its report; the next one ends the program.
class InterruptGuard {
 public:
  InterruptGuard() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &before_);
  }
  ~InterruptGuard() { sigaction(SIGINT, &before_, nullptr); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction before_ {};
};

std::chrono::nanoseconds from_seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

bool read_setup(const Call& call, v1::ProgramSetup& setup) {
  v1::PathSetup& path = *setup.mutable_path();
  path.set_client_tag("trc load");
  if (language_for(call.language) == Language::german) path.set_language("de");
  if (call.masking) {
    path.set_contour_masking(v1::CONTOUR_MASKING_ON);
    path.mutable_options()->set_remove_masked_blocks(true);
  }
  wire::GivenSettings given;
  for (const std::string& assignment : call.assignments) {
    std::string fault = given.take(assignment.substr(0, assignment.find('=')));
    if (fault.empty()) fault = wire::apply_setting(assignment, setup);
    if (fault.empty()) continue;
    complain(fault);
    return false;
  }
  return true;
}

// Reports a plan that the server would refuse before it sends anything.
bool fits(const Call& call, const v1::Limits& limits) {
  const auto is_too_many = [](const std::string& option, std::uint64_t value, std::uint64_t most,
                              const std::string& limit) {
    complain("--" + option + " " + std::to_string(value) + ": the server admits " +
             std::to_string(most) + " (" + limit + ")");
    return false;
  };
  if (call.layout != load::Layout::text && call.batch > limits.max_blocks_per_batch())
    return is_too_many("batch", call.batch, limits.max_blocks_per_batch(), "max_blocks_per_batch");
  if (call.plan.streams > limits.max_streams())
    return is_too_many("streams", call.plan.streams, limits.max_streams(), "max_streams");
  return true;
}

// Exit::unreachable if every error is a lost server, Exit::refused for other faults of a stream.
Exit exit_of(const load::Tally& tally) {
  if (tally.differing > 0) return Exit::refused;
  if (tally.errors.empty()) return Exit::done;
  const bool lost = std::all_of(tally.errors.begin(), tally.errors.end(), [](const auto& error) {
    return error.first.starts_with("UNAVAILABLE");
  });
  return lost ? Exit::unreachable : Exit::refused;
}

Exit run(const Call& call) {
  if (const std::string fault = load::fault_of(call.shape); !fault.empty()) {
    complain(fault);
    return Exit::wrong_call;
  }
  v1::ProgramSetup setup;
  if (!read_setup(call, setup)) return Exit::wrong_call;

  load::Plan plan = call.plan;
  plan.ramp = from_seconds(call.ramp_s);
  plan.duration = from_seconds(call.duration_s);
  plan.verify = call.verify;
  if (plan.open_loop()) plan.grace = grace_of_open_loop;

  ServiceConnections service;
  v1::GetServerInfoResponse info;
  const std::uint64_t connections =
      call.connections != 0 ? call.connections
                            : (plan.streams + streams_per_connection - 1) / streams_per_connection;
  if (const Exit exit = connect(call.service, connections, service, info); exit != Exit::done)
    return exit;
  if (!fits(call, info.limits())) return Exit::wrong_call;
  plan.first_window = std::max(info.limits().max_batches_in_flight(), 1U);

  const load::Job job(call.shape, call.layout, call.batch, std::move(setup));
  std::string refused;
  std::optional<load::ExpectedResult> expected;
  if (plan.verify > 0) {
    expected = load::expected_of(job, refused);
    if (!refused.empty()) {
      complain("the core refuses this contour: " + refused);
      return Exit::refused;
    }
  }
  const std::optional<pid_t> server =
      call.service.server.empty() ? std::nullopt : load::listening_process(call.service.server);
  const InterruptGuard guard;
  load::Generator generator(plan, job, expected ? &*expected : nullptr, server.value_or(0),
                            service.channels);
  const load::Outcome outcome = generator.run(interrupted);
  const load::RunDescription described{.server = call.service.server,
                                       .shape = call.shape.shape,
                                       .connections = service.channels.size()};
  std::cout << (call.json
                    ? report_json(described, plan, job, outcome) + "\n"
                    : report_text(described, plan, job, outcome, language_for(call.language)));
  return exit_of(outcome.tally);
}

void add_load_options(CLI::App& command, Call& call) {
  load::Plan& plan = call.plan;
  auto* rate = command.add_option("--rate", plan.rate,
                                  "Open loop: streams a second, begun on a schedule that does not "
                                  "wait for the server; latencies count from it");
  rate->check(CLI::Range(1e-3, 1e6));
  command
      .add_flag("--closed", call.closed,
                "Closed loop (the default): each stream is followed by the next at once")
      ->excludes(rate);
  command.add_option("--streams", plan.streams, "Streams open at once; with --rate, at most")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command.add_option("--connections", call.connections, "Connections the streams are spread over")
      ->check(CLI::Range(1, 10'000))
      ->default_str("one for 50 streams");
  command.add_option("--duration", call.duration_s, "Seconds to measure, after the ramp")
      ->check(CLI::Range(0.01, 86'400.0))
      ->capture_default_str();
  command.add_option("--ramp", call.ramp_s, "Seconds in which the load grows from nothing")
      ->check(CLI::Range(0.0, 3'600.0))
      ->capture_default_str();
  command.add_option("--jobs", plan.jobs, "End after so many streams, if that is sooner");
  command
      .add_option("--slow-reader", plan.slow,
                  "Share of the streams, 0 to 1, that wait 50 ms before each answer they read")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--cancel-rate", plan.cancel,
                  "Share of the streams, 0 to 1, that are cancelled half way")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--verify", call.verify,
                  "Share of the streams, 0 to 1, whose result is compared with that of the core "
                  "of this program, bit for bit")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void add_job_options(CLI::App& command, Call& call) {
  std::vector<std::string> names;
  for (const load::ShapeRow& row : load::shapes()) names.emplace_back(row.name);
  command.add_option("--shape", call.shape.shape, "Contour of every stream (trc generate --help)")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command.add_option("--seed", call.shape.seed, "Which of the random contours")
      ->capture_default_str();
  command
      .add_option("--tool-radius", call.shape.tool_radius,
                  "The contour is made for it, mm; the tool has it unless --set says another")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command.add_option("--blocks", call.shape.blocks, "Contour blocks of a stream")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}))
      ->capture_default_str();
  command.add_option("--batch", call.batch, "Blocks, or lines, in a message")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  const std::map<std::string, load::Layout> layouts{{"columns", load::Layout::columns},
                                                    {"blocks", load::Layout::blocks},
                                                    {"text", load::Layout::text}};
  command
      .add_option("--layout", call.layout,
                  "columns or blocks (CompensatePath), text (CompensateProgram)")
      ->transform(CLI::CheckedTransformer(layouts).description("{columns,blocks,text}"))
      ->default_str("columns");
  command.add_flag("--masking", call.masking, "G141 with REMOVE_MASKED_BLOCKS");
  command.add_option("--set", call.assignments, "Initial value, key=value (trc compensate --help)")
      ->type_name("KEY=VALUE");
}

}  // namespace

void add_load(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("load", "Run many generated clients against a server and measure");
  command->footer(
      "Every stream sends the same contour. An interrupt (^C) ends the run with the report so "
      "far.");
  auto call = std::make_shared<Call>();
  add_service_options(*command, call->service);
  add_load_options(*command, *call);
  add_job_options(*command, *call);
  command->add_flag("--json", call->json, "Print the report as one JSON object");
  add_language_option(*command, call->language);
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
