#include <absl/synchronization/mutex.h>
#include <google/protobuf/stubs/logging.h>
#include <grpc/support/log.h>
#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <semaphore>
#include <string>
#include <thread>

#include "core/base/version.h"
#include "server/config/config.h"
#include "server/resources/heap_reserve.h"
#include "server/resources/round.h"
#include "server/resources/thread_reserve.h"
#include "server/server.h"
#include "server/service_manager.h"

namespace {

using trc::server::Log;
using trc::server::LogLine;
namespace service_manager = trc::server::service_manager;

constexpr auto look_interval = std::chrono::seconds(1);
constexpr auto longest_flush = std::chrono::seconds(1);

// Blocks these signals in this thread and all later ones: they are waited for, not caught.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

const Log& grpc_log() {
  static const Log log("off");
  return log;
}

// Sends messages of gRPC and Protobuf, such as a failed handshake or invalid UTF-8, to the log. If
// nobody reads standard error, writing there would block their threads.
void adopt_library_logs(const trc::server::Config& config) {
  grpc_log().set_level(config.log_level);
  grpc_log().set_most_lines_per_second(config.max_log_lines_per_s);
  google::protobuf::SetLogHandler(
      [](google::protobuf::LogLevel, const char*, int, const std::string& message) {
        grpc_log().info(LogLine("protobuf").text("message", message));
      });
  gpr_set_log_function([](gpr_log_func_args* message) {
    const LogLine line = LogLine("grpc").text("message", message->message);
    if (message->severity == GPR_LOG_SEVERITY_ERROR) {
      grpc_log().warning(line);
    } else {
      grpc_log().info(line);
    }
  });
}

// The next signal, or 0 after `longest`.
int wait_for(const sigset_t& signals, std::chrono::microseconds longest) {
  const timespec limit{.tv_sec = static_cast<time_t>(longest.count() / 1'000'000),
                       .tv_nsec = static_cast<long>(longest.count() % 1'000'000) * 1000};
  const int signal = sigtimedwait(&signals, nullptr, &limit);
  return signal > 0 ? signal : 0;
}

// Reloads the log level and the certificates. Other settings need a restart; the log names those
// that differ from the start. A configuration that cannot be read changes nothing.
void reload(int argc, char** argv, trc::server::Config at_start, trc::server::Server& server) {
  service_manager::reloading();
  const auto& log = server.backend().telemetry.log;
  const trc::server::CommandLine again = trc::server::read_command_line(argc, argv);
  if (again.exit) {
    log.warning(LogLine("reload_refused").text("fault", again.exit->text));
  } else {
    log.set_level(again.config.log_level);
    grpc_log().set_level(again.config.log_level);
    log.info(LogLine("reloaded").text("log_level", again.config.log_level));
    at_start.log_level = again.config.log_level;
    std::string untaken;
    for (const std::string& name : trc::server::differing_settings(at_start, again.config))
      untaken += (untaken.empty() ? "" : ",") + name;
    if (!untaken.empty()) log.warning(LogLine("restart_needed").text("settings", untaken));
  }
  server.reload_certificates();
  service_manager::ready();
}

// Serves until a signal asks it to stop; then true. False if streams may wait for a thread that
// could not be made: they go on elsewhere or after a restart.
bool serve(int argc, char** argv, const trc::server::Config& at_start, const sigset_t& signals,
           trc::server::Server& server) {
  const auto watchdog = service_manager::watchdog_interval();
  std::chrono::microseconds interval = look_interval;
  if (watchdog.count() > 0) interval = std::min(interval, watchdog);
  for (;;) {
    const int signal = wait_for(signals, interval);
    if (signal == SIGTERM || signal == SIGINT) return true;
    if (trc::server::ThreadReserve::failed()) {
      server.backend().telemetry.log.error(LogLine("threads_missing"));
      return false;
    }
    trc::server::ThreadReserve::refill();
    if (signal == SIGHUP) trc::server::do_round([&] { reload(argc, argv, at_start, server); });
    trc::server::do_round([&] { server.look_after(); });
    if (server.is_well()) service_manager::alive();
  }
}

// A second signal ends the process without waiting for open streams; so does the end of the time
// for draining. Until then the thread feeds the watchdog, because draining is no hang.
void exit_at_next(const sigset_t& signals, std::chrono::seconds drain_timeout, const Log& log) {
  constexpr auto grace = std::chrono::milliseconds(1500);
  const auto latest = std::chrono::steady_clock::now() + drain_timeout + grace;
  for (;;) {
    const auto left = latest - std::chrono::steady_clock::now();
    const int signal = wait_for(
        signals, std::min<std::chrono::microseconds>(
                     look_interval, std::chrono::duration_cast<std::chrono::microseconds>(left)));
    if (signal == SIGTERM || signal == SIGINT) _exit(1);
    if (std::chrono::steady_clock::now() >= latest) {
      trc::server::do_round([&] { log.error(LogLine("drain_overrun")); });
      Log::flush(longest_flush);
      _exit(1);
    }
    service_manager::alive();
  }
}

// The thread that enforces the end. It exists from the start, because there may be no room for a
// thread later.
class Drain {
 public:
  Drain(const sigset_t& signals, std::chrono::seconds timeout, const Log& log) {
    std::thread([this, signals, timeout, &log] {
      begun_.acquire();
      exit_at_next(signals, timeout, log);
    }).detach();
  }
  void begin() { begun_.release(); }

 private:
  std::binary_semaphore begun_{0};
};

void log_start(trc::server::Server& server) {
  const trc::server::Config& config = server.backend().config;
  const auto& listen = config.listen;
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
          .number("admin_port", static_cast<std::uint64_t>(server.admin_port()))
          .number("health_port", static_cast<std::uint64_t>(server.health_port()))
          .number("http_port", static_cast<std::uint64_t>(server.http_port()))
          .number("memory_limit_mib", std::uint64_t{config.memory_limit_mib})
          .number("max_session_memory_mib", std::uint64_t{config.max_session_memory_mib})
          .number("max_grpc_buffer_mib", std::uint64_t{config.max_grpc_buffer_mib})
          .number("max_streams", std::uint64_t{config.max_streams}));
}

// Streams move from thread to thread. With one heap per thread, the default of glibc, the memory
// they leave behind is several times the memory they hold.
void share_heap() {
  const unsigned threads = std::max(2U, std::thread::hardware_concurrency());
  mallopt(M_ARENA_MAX, static_cast<int>(threads));
  // A batch takes some hundred kilobytes and is soon freed: the next one reuses its pages.
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 8 << 20);
}

int no_threads() {
  std::fprintf(stderr,
               "trcd: error: The system gives too few threads to serve with (pids.max of the "
               "cgroup, TasksMax of the unit, ulimit -u)\n");
  return 1;
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

  // Debian's Abseil looks for deadlocks of gRPC at every lock, under one lock of its own, and ends
  // the process if it finds no memory for its notes.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  share_heap();
  trc::server::HeapReserve::install();
  const sigset_t signals = block_signals();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a log that may not grow any more
  // Other servers rotate their logs on these signals; here they must not end the streams.
  for (const int other : {SIGUSR1, SIGUSR2, SIGALRM}) std::signal(other, SIG_IGN);
  adopt_library_logs(command_line.config);
  using trc::server::ThreadReserve;
  const std::size_t spare = ThreadReserve::usual();
  if (!ThreadReserve::install(spare + ThreadReserve::at_start()) || !ThreadReserve::install(spare))
    return no_threads();
  auto [server, fault, misconfigured] = trc::server::Server::start(command_line.config);
  if (server == nullptr) {
    std::fprintf(stderr, "trcd: error: %s\n", fault.c_str());
    return misconfigured ? 2 : 1;
  }
  if (!ThreadReserve::refill()) return no_threads();
  log_start(*server);
  const auto& log = server->backend().telemetry.log;
  // Static, because its thread lives as long as the process.
  static Drain drain(signals, std::chrono::seconds(command_line.config.drain_timeout_s), log);

  service_manager::ready();

  const bool asked = serve(argc, argv, command_line.config, signals, *server);
  service_manager::stopping();
  drain.begin();
  log.info(LogLine("draining").number("streams", std::uint64_t{server->backend().streams.count()}));
  const std::size_t cut_off = server->drain();
  log.info(LogLine("stopped").number("streams_cut_off", std::uint64_t{cut_off}));
  // With a limit: if nobody reads the log, its writer never returns.
  const int code = asked ? 0 : 1;
  if (!Log::flush(longest_flush)) _exit(code);
  return code;
}
