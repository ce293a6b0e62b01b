#include "client/cli/service.h"

#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "client/cli/printable.h"
#include "client/cli/speech.h"
#include "client/cli/unreachable.h"
#include "client/trc/connection.h"
#include "client/trc/remote_program_session.h"
#include "client/trc/survey.h"
#include "proto/wire/diagnostic.h"
#include "server/in_process.h"
#include "server/resources/limits.h"
#include "server/resources/memory_watch.h"

namespace trc::cli {

struct KeptService {
  std::shared_ptr<server::InProcessServer> own{};
  std::optional<client::Connection> connection{};
};

namespace {

constexpr std::chrono::seconds longest_question{10};

// A field of the setup in the spelling of --set.
std::string_view as_setting(std::string_view field) {
  for (const std::string_view above : {"setup.", "path."})
    if (field.starts_with(above)) field.remove_prefix(above.size());
  return field;
}

// The service of one run: a remote server, or one in this process.
class Service {
 public:
  explicit Service(const ServiceOptions& options, const client::ConnectionOptions& how = {})
      : name_(options.server) {
    if (options.kept && options.kept->connection) {
      own_ = options.kept->own;
      connection_ = own_ ? options.kept->connection : options.kept->connection->with(how.resume);
      return;
    }
    open(options, how);
    if (options.kept && !failure_) *options.kept = {.own = own_, .connection = connection_};
  }

  [[nodiscard]] const std::optional<client::Failure>& failure() const { return failure_; }
  [[nodiscard]] const client::Connection& connection() const { return *connection_; }
  [[nodiscard]] const std::shared_ptr<server::InProcessServer>& own_server() const { return own_; }

  // How much a failed call had answered.
  enum class Answered : std::uint8_t { nothing, a_part };
  // Reports the failure and returns the exit code.
  [[nodiscard]] Exit explain(const client::Failure& failure, Answered answered) const {
    if (failure.reason == "CALLER_STOPPED") return Exit::wrong_call;
    for (const wire::FieldFault& field : failure.fields)
      complain(std::string(as_setting(field.field)) + ": " + field.description);
    if (failure.unreachable())
      explain_unreachable(failure, answered);
    else if (failure.reason == "MEMORY_LIMIT" && name_.empty())
      complain(
          "the program needs more memory than this run may take; raise --max-session-memory-mib or "
          "--memory-limit-mib, or hold less: --set look_ahead_blocks=10000 --set verify=off");
    else if (failure.fields.empty())
      complain(failure.message);
    return exit_of(failure, name_.empty() ? ServedBy::this_process : ServedBy::server);
  }

 private:
  void open(const ServiceOptions& options, const client::ConnectionOptions& how) {
    if (!options.server.empty()) {
      if (options.has_own_limits()) {
        failure_ = wrong_call(
            "--memory-limit-mib, --max-session-memory-mib and --max-blocks-per-selection are of a "
            "run in this process; a server has limits of its own (trc info --server)",
            "LIMITS_WRONG");
        return;
      }
      if (std::string fault = fault_of_tls_files(options); !fault.empty()) {
        failure_ = wrong_call(std::move(fault), "TLS_FILES_INVALID");
        return;
      }
      failure_ = client::Connection::open(
          options.server, {.ca = options.tls_ca, .cert = options.tls_cert, .key = options.tls_key},
          connection_, how);
      return;
    }
    server::Config config = server::InProcessServer::quiet();
    // Short, so that the server soon reports how much of a path it has measured.
    config.heartbeat_s = 1;
    config.memory_limit_mib = options.memory_limit_mib;
    config.max_session_memory_mib = options.max_session_memory_mib;
    if (options.max_blocks_per_selection > 0)
      config.max_blocks_per_selection = options.max_blocks_per_selection;
    server::Config added_up = config;
    if (auto fault = fill_in_own_limits(added_up, server::memory_limit_bytes())) {
      failure_ = wrong_call("--" + std::move(*fault), "LIMITS_WRONG");
      return;
    }
    own_ = std::make_shared<server::InProcessServer>(config);
    // Waiting is useless here: only this run can make room in this process.
    connection_.emplace(own_->channel(),
                        client::ResumePolicy{.patience = std::chrono::milliseconds::zero()});
  }

  static client::Failure wrong_call(std::string fault, std::string reason) {
    return {.status = "INVALID_ARGUMENT", .message = std::move(fault), .reason = std::move(reason)};
  }

  void explain_unreachable(const client::Failure& failure, Answered answered) const {
    // If a server gives a reason, the message is the server's; otherwise it is of the transport.
    if (failure.reason == "SERVER_DRAINING" && !name_.empty()) {
      complain("the server at " + name_ + " is there, but shuts down and takes no new programs");
    } else if (failure.reason == "DRAIN_TIMEOUT") {
      complain("the server at " + name_ +
               " has shut down before the path was complete; run it again, or raise its "
               "drain-timeout-s");
    } else if (failure.not_taken_over()) {
      complain("the server at " + name_ +
               " was lost, and the one there now cannot go on: it was started anew, or has another "
               "resume-key-file or version; run it again");
    } else if (!failure.reason.empty()) {
      complain(failure.message);
    } else if (failure.status == "UNAUTHENTICATED" || failure.status == "PERMISSION_DENIED") {
      complain("the server at " + name_ + " does not let this client in");
    } else if (answered == Answered::a_part) {
      complain("lost the connection to the server" + (name_.empty() ? "" : " at " + name_) +
               "; the path is not complete");
    } else {
      complain("cannot reach a server at " + name_ + why_unreachable(failure.message));
    }
  }

  std::string name_;
  std::shared_ptr<server::InProcessServer> own_;
  std::optional<client::Connection> connection_;
  std::optional<client::Failure> failure_;
};

// Reports on standard error why nothing goes on, each reason once.
class Patience {
 public:
  Patience(const ServiceOptions& options, Reporter& reporter)
      : options_(options), reporter_(reporter) {}

  [[nodiscard]] client::ConnectionOptions how() {
    client::ConnectionOptions options;
    options.resume.patience = std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(options_.wait_s));
    options.resume.waiting = [this](const client::Failure& why) { tell(why); };
    return options;
  }

 private:
  void tell(const client::Failure& why) {
    if (reporter_.is_quiet() || !told_.insert(why.status + why.reason).second) return;
    std::string text = "the server at " + options_.server;
    if (why.reason == "SERVER_DRAINING" || why.reason == "DRAIN_TIMEOUT")
      text += " shuts down";
    else if (why.asks_to_wait())
      text += " has no room now: " + why.message;
    else
      text += " was lost";
    reporter_.progress().clear();
    std::ostringstream seconds;
    seconds << options_.wait_s;
    complain(text + "; waiting for up to " + seconds.str() + " s (--wait)");
  }

  const ServiceOptions& options_;
  Reporter& reporter_;
  std::set<std::string> told_{};
};

// The exit code for a program that was refused.
Exit exit_of_refused(const client::Failure& failure) {
  return exit_of(failure, ServedBy::server) == Exit::limit ? Exit::limit : Exit::refused;
}

}  // namespace

Exit exit_of(const client::Failure& failure, ServedBy served_by) {
  // Balancers also report INTERNAL for a server that died, but without a reason.
  if (failure.status == "INTERNAL" &&
      (served_by == ServedBy::this_process || !failure.reason.empty()))
    return Exit::internal;
  if (failure.unreachable()) return Exit::unreachable;
  return failure.status == "RESOURCE_EXHAUSTED" ? Exit::limit : Exit::wrong_call;
}

std::shared_ptr<KeptService> keep_service() { return std::make_shared<KeptService>(); }

void add_service_options(CLI::App& command, ServiceOptions& options) {
  auto* server =
      command.add_option("--server", options.server,
                         "Server to ask, or several with commas between; without it the work is "
                         "done in this process");
  server->type_name("HOST:PORT")->envname("TRC_SERVER");
  const auto add_file = [&](const char* name, std::string& path, const char* meaning) {
    command.add_option(name, path, meaning)
        ->type_name("PEM")
        ->check(CLI::ExistingFile)
        ->needs(server);
  };
  command
      .add_option("--wait", options.wait_s,
                  "How long to wait for a server that has no room, shuts down or was lost, s; 0: "
                  "not at all")
      ->type_name("S")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  command
      .add_option("--memory-limit-mib", options.memory_limit_mib,
                  "Without a server: what this process may take; else all there is")
      ->type_name("MIB")
      ->check(CLI::Range(64, 1 << 30));
  command
      .add_option("--max-session-memory-mib", options.max_session_memory_mib,
                  "Without a server: what a program may hold of it; else five eighths")
      ->type_name("MIB")
      ->check(CLI::Range(1, 1 << 30));
  command
      .add_option("--max-blocks-per-selection", options.max_blocks_per_selection,
                  "Without a server: most blocks between G41 or G42 and G40; else 20000000")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000'000));
  add_file("--tls-ca", options.tls_ca, "Certificate (PEM) the server is known by");
  add_file("--tls-cert", options.tls_cert, "Certificate (PEM) of this client");
  add_file("--tls-key", options.tls_key, "Key (PEM) of that certificate");
}

Outcome compensate_program(const ServiceOptions& options, const v1::ProgramSetup& setup,
                           Input& input, Reporter& reporter, const AnswerSink& sink) {
  Patience patience(options, reporter);
  const Service service(options, patience.how());
  if (service.failure())
    return {.exit = service.explain(*service.failure(), Service::Answered::nothing)};
  client::RemoteProgramSession session(service.connection(), setup);
  Progress& progress = reporter.progress();
  session.tell_measuring(
      [&](std::uint64_t measured, std::uint64_t all) { progress.measured(measured, all); });
  auto answered = Service::Answered::nothing;
  std::uint64_t bytes = 0;
  Answers answers([&](Answer& answer) {
    answered = Service::Answered::a_part;
    reporter.report(answer.diagnostics);
    progress.read(bytes, input.size());
    return sink(answer);
  });

  bool open = true;
  while (open) {
    const std::string_view text = input.read();
    if (text.empty()) break;
    bytes += text.size();
    open = session.feed(text, answers);
    progress.read(bytes, input.size());
  }
  // A partial program must not look like a whole one.
  if (input.failed()) return {.exit = Exit::wrong_call};
  progress.read(bytes, bytes);
  const bool done = open && session.finish(answers);
  reporter.finish();
  Outcome outcome{.core_version = session.core_version()};
  if (done)
    outcome.summary = session.summary();
  else if (reporter.refused())
    // A lack of room on the server also appears as a diagnostic; the program has no fault.
    outcome.exit = session.failure() ? exit_of_refused(*session.failure()) : Exit::refused;
  else
    outcome.exit =
        session.failure() ? service.explain(*session.failure(), answered) : Exit::internal;
  return outcome;
}

Exit survey_program(const ServiceOptions& options, const v1::SurveySetup& setup,
                    std::string_view text, Reporter& reporter, v1::SurveyAnswer& answer) {
  Patience patience(options, reporter);
  const Service service(options, patience.how());
  if (service.failure()) return service.explain(*service.failure(), Service::Answered::nothing);
  auto answered = Service::Answered::nothing;
  const auto failure = client::survey_program(
      service.connection(), setup, text, [&](const v1::SurveyRadiiResponse& response) {
        answered = Service::Answered::a_part;
        for (const v1::Diagnostic& told : response.diagnostics()) {
          reporter.report({wire::from_proto(told)});
          *answer.add_diagnostics() = told;
        }
        if (response.has_radius()) *answer.add_radii() = response.radius();
        if (response.has_summary()) *answer.mutable_summary() = response.summary();
        return true;
      });
  reporter.finish();
  if (!failure) return Exit::done;
  if (!reporter.refused()) return service.explain(*failure, answered);
  return exit_of_refused(*failure);
}

Exit connect(const ServiceOptions& options, std::size_t count, ServiceConnections& connections,
             v1::GetServerInfoResponse& info) {
  if (options.server.empty()) count = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Service service(options, {.separate = true});
    if (service.failure()) return service.explain(*service.failure(), Service::Answered::nothing);
    if (const auto failure = service.connection().server_info(longest_question, info))
      return service.explain(*failure, Service::Answered::nothing);
    make_printable(info);
    connections.own_server = service.own_server();
    connections.channels.push_back(service.connection().channel());
  }
  return Exit::done;
}

Exit server_info(const ServiceOptions& options, v1::GetServerInfoResponse& info) {
  const Service service(options);
  if (service.failure()) return service.explain(*service.failure(), Service::Answered::nothing);
  const auto failure = service.connection().server_info(longest_question, info);
  make_printable(info);
  return failure ? service.explain(*failure, Service::Answered::nothing) : Exit::done;
}

Exit server_health(const ServiceOptions& options, std::chrono::seconds timeout, bool& serving) {
  const Service service(options);
  if (service.failure()) return service.explain(*service.failure(), Service::Answered::nothing);
  const auto failure = service.connection().health(timeout, serving);
  return failure ? service.explain(*failure, Service::Answered::nothing) : Exit::done;
}

}  // namespace trc::cli
