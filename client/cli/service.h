#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/reporter.h"
#include "client/trc/failure.h"
#include "core/session/answers.h"
#include "proto/wire/path_item.h"
#include "trc/v1/http.pb.h"
#include "trc/v1/setup.pb.h"
#include "trc/v1/trc_service.pb.h"

namespace grpc {
class Channel;
}

namespace trc::cli {

// A service for several programs one after another, made for the first of them.
struct KeptService;

// Where the service is. Without an address it runs inside this process.
struct ServiceOptions {
  std::string server{};  // as Connection::open takes it
  std::string tls_ca{};  // PEM files
  std::string tls_cert{};
  std::string tls_key{};
  // Waiting time for a server that is full, shuts down or was lost, s.
  double wait_s = 60;
  // Of a run in this process, as the settings of trcd that have these names; 0: as without them.
  std::uint32_t memory_limit_mib = 0;
  std::uint32_t max_session_memory_mib = 0;
  std::uint64_t max_blocks_per_selection = 0;
  // Where given, the connection, or the service in this process, stays between calls with the same
  // options.
  std::shared_ptr<KeptService> kept{};

  [[nodiscard]] bool has_own_limits() const {
    return memory_limit_mib > 0 || max_session_memory_mib > 0 || max_blocks_per_selection > 0;
  }
};
[[nodiscard]] std::shared_ptr<KeptService> keep_service();
void add_service_options(CLI::App& command, ServiceOptions& options);

struct Outcome {
  Exit exit = Exit::done;
  // Version of the compensating core, as "0.1.0+0123456789ab"; empty: no service took it.
  std::string core_version{};
  std::optional<wire::ProgramSummary> summary{};  // complete runs only
};

// Sends a program and hands out the answers in order. Diagnostics of the program
// and what else went wrong are on standard error when it returns.
[[nodiscard]] Outcome compensate_program(const ServiceOptions& options,
                                         const v1::ProgramSetup& setup, Input& input,
                                         Reporter& reporter, const AnswerSink& sink);

// Surveys a program with tools of many radii. Faults are on standard error when it returns.
[[nodiscard]] Exit survey_program(const ServiceOptions& options, const v1::SurveySetup& setup,
                                  std::string_view text, Reporter& reporter,
                                  v1::SurveyAnswer& answer);

// Who has served a call. On the way to a service in this process nothing can be lost.
enum class ServedBy : std::uint8_t { this_process, server };

// How the program ends after a call that failed for another reason than the program it carried.
[[nodiscard]] Exit exit_of(const client::Failure& failure, ServedBy served_by);

// Connections for streams of the caller's own.
struct ServiceConnections {
  std::vector<std::shared_ptr<grpc::Channel>> channels{};
  std::shared_ptr<void> own_server{};  // keeps the server of this process, if it is asked
};
// Opens `count` connections and asks the server what it is. Without an address there is one, into
// this process.
[[nodiscard]] Exit connect(const ServiceOptions& options, std::size_t count,
                           ServiceConnections& connections, v1::GetServerInfoResponse& info);

// Each reports on standard error why there is no answer.
[[nodiscard]] Exit server_info(const ServiceOptions& options, v1::GetServerInfoResponse& info);
[[nodiscard]] Exit server_health(const ServiceOptions& options, std::chrono::seconds timeout,
                                 bool& serving);

}  // namespace trc::cli
