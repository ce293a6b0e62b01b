#include <grpc/support/log.h>
#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "core/base/version.h"
#include "server/config.h"
#include "server/server.h"

namespace {

using trc::server::LogLine;

// SIGTERM and SIGINT are waited for, not caught: blocked in every thread that is started later.
sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// gRPC's own messages, a failed handshake say, join the log instead of going to standard error.
void adopt_grpc_log(const std::string& level) {
  static const trc::server::Log log(level);
  gpr_set_log_function([](gpr_log_func_args* message) {
    const LogLine line = LogLine("grpc").text("message", message->message);
    if (message->severity == GPR_LOG_SEVERITY_ERROR) {
      log.warning(line);
    } else {
      log.info(line);
    }
  });
}

void wait_for(const sigset_t& signals) {
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) {
  }
}

// Who sends the signal twice does not want to wait for open streams.
void exit_at_next(const sigset_t& signals) {
  std::thread([signals] {
    wait_for(signals);
    _exit(1);
  }).detach();
}

void log_start(trc::server::Server& server) {
  const auto& listen = server.backend().config.listen;
  std::string addresses;
  std::string ports;
  for (std::size_t i = 0; i < listen.size(); ++i) {
    if (i > 0) {
      addresses += ',';
      ports += ',';
    }
    addresses += listen[i];
    ports += std::to_string(server.ports()[i]);
  }
  server.backend().telemetry.log.info(
      LogLine("started")
          .text("version", trc::version())
          .text("commit", trc::commit())
          .text("listen", addresses)
          .text("ports", ports)
          .number("admin_port", static_cast<std::uint64_t>(server.admin_port())));
}

}  // namespace

int main(int argc, char** argv) {
  const trc::server::CommandLine command_line = trc::server::read_command_line(argc, argv);
  if (command_line.exit) {
    const bool fault = command_line.exit->code != 0;
    std::fprintf(fault ? stderr : stdout, fault ? "trcd: error: %s\n" : "%s",
                 command_line.exit->text.c_str());
    return command_line.exit->code;
  }

  const sigset_t signals = block_stop_signals();
  std::signal(SIGPIPE, SIG_IGN);
  adopt_grpc_log(command_line.config.log_level);
  auto [server, fault] = trc::server::Server::start(command_line.config);
  if (server == nullptr) {
    std::fprintf(stderr, "trcd: error: %s\n", fault.c_str());
    return 1;
  }
  log_start(*server);

  wait_for(signals);
  exit_at_next(signals);
  const auto& log = server->backend().telemetry.log;
  log.info(LogLine("draining").number("streams", std::uint64_t{server->backend().streams.count()}));
  const std::size_t cut_off = server->drain();
  log.info(LogLine("stopped").number("streams_cut_off", std::uint64_t{cut_off}));
  log.flush();
  return 0;
}
