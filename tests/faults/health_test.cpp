// What the built server says of its health while its worker stands still, as one does that waits
// for a lock nobody gives back: one of its threads is stopped from outside.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <thread>

#include "grpc/health/v1/health.grpc.pb.h"
#include "tests/faults/long_stream.h"
#include "tests/faults/questions.h"
#include "tests/faults/service_manager.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using grpc::health::v1::HealthCheckResponse;
using server::eventually;
using std::chrono::milliseconds;
using testing_support::Folder;
using testing_support::http_get;
using testing_support::ServerProcess;

// By thread the ticks it has computed.
std::map<pid_t, long> ticks_of_threads(pid_t process) {
  std::map<pid_t, long> ticks;
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::ifstream file(thread.path() / "stat");
    const std::string line{std::istreambuf_iterator<char>(file), {}};
    std::istringstream fields(line.substr(line.rfind(')') + 1));
    std::string field;
    for (int i = 0; i < 12; ++i) fields >> field;
    if (!field.empty()) ticks[std::stoi(thread.path().filename().string())] = std::stol(field);
  }
  return ticks;
}

// The one that computes most.
pid_t busiest_thread(pid_t process) {
  const auto before = ticks_of_threads(process);
  std::this_thread::sleep_for(milliseconds(500));
  pid_t busiest = 0;
  long most = 0;
  for (const auto& [thread, ticks] : ticks_of_threads(process)) {
    const auto found = before.find(thread);
    const long more = ticks - (found == before.end() ? 0 : found->second);
    if (more > most) {
      most = more;
      busiest = thread;
    }
  }
  return busiest;
}

class StoppedThread {
 public:
  explicit StoppedThread(pid_t thread) : thread_(thread) {
    stopped_ = ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) == 0 &&
               ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 &&
               waitpid(thread, nullptr, __WALL) == thread;
  }
  ~StoppedThread() { ptrace(PTRACE_DETACH, thread_, nullptr, nullptr); }
  StoppedThread(const StoppedThread&) = delete;
  StoppedThread& operator=(const StoppedThread&) = delete;

  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  pid_t thread_;
  bool stopped_ = false;
};

HealthCheckResponse::ServingStatus health_of(const std::string& address) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
  HealthCheckResponse response;
  grpc::health::v1::Health::NewStub(channel_to(address))->Check(&context, {}, &response);
  return response.status();
}

TEST(Health, TellsOfAWorkerThatStandsStillUntilItGoesOn) {
  const Folder folder;
  ServiceManager manager(folder.path("notify"));
  const ServerProcess server(
      {"--worker-threads", "1", "--stall-timeout-s", "1", "--max-selection-cpu-s", "0",
       "--admin-listen", "127.0.0.1:0", "--drain-timeout-s", "0"},
      "127.0.0.1:0", 0, {"NOTIFY_SOCKET=" + folder.path("notify"), "WATCHDOG_USEC=400000"});
  const auto says = [&](HealthCheckResponse::ServingStatus status, const std::string& readiness) {
    return eventually([&] {
      return health_of(server.address()) == status &&
             http_get(server.admin(), "/readyz") == readiness;
    });
  };
  const LongStream busy(channel_to(server.address()),
                        laps(1000, "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]\n"));
  ASSERT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 1; }));
  EXPECT_TRUE(says(HealthCheckResponse::SERVING, "ready\n"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  {
    const StoppedThread worker(busiest_thread(server.id()));
    if (!worker.stopped()) GTEST_SKIP() << "no thread may be traced here";
    EXPECT_TRUE(says(HealthCheckResponse::NOT_SERVING, "stalled: streams wait for a worker\n"));
    EXPECT_GT(metric(server.admin(), "trc_pool_longest_wait_seconds"), 1);
    EXPECT_EQ(http_get(server.admin(), "/healthz"), "ok\n");
    // Later the service manager hears no sign of life either, and would start it again.
    EXPECT_TRUE(eventually([&] { return manager.hears_nothing_for(milliseconds(1200)); }));
    EXPECT_NE(server.log().find("\"stalled\""), std::string::npos);
  }
  EXPECT_TRUE(says(HealthCheckResponse::SERVING, "ready\n"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  EXPECT_TRUE(
      eventually([&] { return server.log().find("\"serving_again\"") != std::string::npos; }));
  EXPECT_TRUE(serves(server.address()));
}

}  // namespace
}  // namespace trc::faults
