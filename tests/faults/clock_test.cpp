// The built server while its wall clock jumps: nothing that is asked for hangs, and it ends in
// time.

#include <fcntl.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/faults/long_stream.h"
#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using std::chrono::seconds;
using testing_support::Folder;
using testing_support::memory_tells;
using testing_support::ServerProcess;
using Clock = std::chrono::steady_clock;

// The file that says how far the clock is off, which the server has in its memory.
class ShiftedClock {
 public:
  ShiftedClock() : file_(open(path().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    jump_to(seconds(0));
  }
  ~ShiftedClock() { close(file_); }
  ShiftedClock(const ShiftedClock&) = delete;
  ShiftedClock& operator=(const ShiftedClock&) = delete;

  // From here on so far from the time that it is.
  void jump_to(seconds shift) const {
    const std::int64_t count = shift.count();
    EXPECT_EQ(pwrite(file_, &count, sizeof count, 0), static_cast<ssize_t>(sizeof count));
  }
  [[nodiscard]] std::vector<std::string> environment() const {
    return {"LD_PRELOAD=" SHIFTED_CLOCK_LIBRARY, "SHIFTED_CLOCK=" + path()};
  }

 private:
  [[nodiscard]] std::string path() const { return folder_.path("clock"); }

  Folder folder_;
  int file_;
};

void expect_answers_soon(const ServerProcess& server) {
  const auto begin = Clock::now();
  EXPECT_TRUE(serves(server.address()));
  EXPECT_EQ(testing_support::http_get(server.admin(), "/readyz"), "ready\n");
  EXPECT_LT(Clock::now() - begin, seconds(10));
}

TEST(Clock, ThatJumpsHangsNothing) {
  if (!memory_tells) GTEST_SKIP() << "a sanitizer must be the first library there is";
  const ShiftedClock clock;
  ServerProcess server(
      {"--admin-listen", "127.0.0.1:0", "--idle-timeout-s", "3", "--drain-timeout-s", "1"},
      "127.0.0.1:0", 0, clock.environment());
  ASSERT_TRUE(serves(server.address()));
  constexpr seconds half_a_day{12 * 3600};
  for (const seconds shift : {half_a_day, -half_a_day, seconds(120), seconds(-3600)}) {
    SCOPED_TRACE(shift.count());
    LongStream busy(channel_to(server.address()), laps(100));
    // A client that says no more: it is sent away when it has been silent for long, not before.
    grpc::ClientContext context;
    const auto stub = v1::TrcService::NewStub(channel_to(server.address()));
    const auto silent = stub->CompensateProgram(&context);
    silent->Write(server::setup_request(v1::ProgramSetup()));
    v1::CompensateProgramResponse response;
    ASSERT_TRUE(silent->Read(&response));
    const auto begin = Clock::now();
    clock.jump_to(shift);
    expect_answers_soon(server);
    EXPECT_FALSE(silent->Read(&response));
    EXPECT_EQ(silent->Finish().error_code(), grpc::ABORTED);
    EXPECT_GT(Clock::now() - begin, seconds(2));
    EXPECT_LT(Clock::now() - begin, seconds(20));
    EXPECT_TRUE(busy.end().status.ok());
  }
  LongStream busy(channel_to(server.address()), laps(1000));
  ASSERT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 1; }));
  clock.jump_to(-half_a_day);
  const auto told = Clock::now();
  server.signal(SIGTERM);
  clock.jump_to(half_a_day);
  server.wait();
  EXPECT_LT(Clock::now() - told, seconds(1 + 2) + std::chrono::milliseconds(500));
}

}  // namespace
}  // namespace trc::faults
