// The built server against clients that compute for long: whose turn it is, how long a selection
// and a stream may take, and what others notice of it.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/faults/long_stream.h"
#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using server::StreamAnswer;
using std::chrono::seconds;
using testing_support::Folder;
using testing_support::ServerProcess;
using testing_support::times_slower;
using Clock = std::chrono::steady_clock;
using Busy = std::vector<std::unique_ptr<LongStream>>;

// What computes for long over a contour that is travelled over itself.
struct Work {
  const char* name;
  std::string head;
  v1::ProgramSetup setup{};
};

v1::ProgramSetup measured() {
  v1::ProgramSetup setup;
  setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT);
  return setup;
}

v1::ProgramSetup implicitly_masked() {
  v1::ProgramSetup setup;
  setup.mutable_path()->set_implicit_contour_masking(true);
  return setup;
}

const std::string removal = "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]\n";

std::vector<Work> works() {
  return {{"Masking", "G141\n"},
          {"Removal", removal},
          {"ImplicitMasking", "", implicitly_masked()},
          {"Measuring", "", measured()},
          {"MeasuringOfMasking", "G141\n", measured()}};
}

class LongWork : public testing::TestWithParam<Work> {
 protected:
  static std::unique_ptr<LongStream> begin(const std::string& address, int count) {
    return std::make_unique<LongStream>(channel_to(address), laps(count, GetParam().head),
                                        GetParam().setup);
  }
};

// How long somebody else waits for a small program, at most.
double longest_wait_s(const std::string& address, int rounds) {
  double longest = 0;
  for (int i = 0; i < rounds; ++i) {
    const auto begin = Clock::now();
    EXPECT_TRUE(serves(address));
    longest = std::max(longest, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return longest;
}

// Either all of it comes, or a refusal that names the setting.
TEST_P(LongWork, EndsByItselfOrByItsLimit) {
  const ServerProcess server({"--max-selection-cpu-s", "1"});
  const StreamAnswer answer = begin(server.address(), 1000)->end();
  if (answer.status.ok()) {
    EXPECT_TRUE(answer.text.ends_with("M30\n"));
    return;
  }
  EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(answer.reason(), "CPU_LIMIT") << answer.status.error_message();
  EXPECT_EQ(answer.metadata("setting"), "max-selection-cpu-s");
}

// Two that compute on both workers, and others beside them; and it ends when it is told to.
TEST_P(LongWork, KeepsNobodyFromHisTurn) {
  const Folder folder;
  const std::string socket = "unix:" + folder.path("socket");
  ServerProcess server(
      {"--worker-threads", "2", "--drain-timeout-s", "1", "--max-selection-cpu-s", "0"},
      "127.0.0.1:0," + socket);
  Busy busy;
  for (int i = 0; i < 4; ++i) busy.push_back(begin(server.address(), 1000));
  std::this_thread::sleep_for(seconds(1));
  EXPECT_LT(longest_wait_s(socket, 5), 5 * times_slower);
  const auto told = Clock::now();
  server.signal(SIGTERM);
  server.wait();
  EXPECT_LT(Clock::now() - told, seconds(1 + 2) + times_slower * std::chrono::milliseconds(500));
}

INSTANTIATE_TEST_SUITE_P(Works, LongWork, testing::ValuesIn(works()),
                         [](const auto& work) { return work.param.name; });

TEST(Turns, AStreamMayComputeForSoLong) {
  const ServerProcess server({"--max-stream-cpu-s", "1", "--max-selection-cpu-s", "0"});
  const StreamAnswer answer = LongStream(channel_to(server.address()), laps(1000)).end();
  EXPECT_EQ(answer.reason(), "CPU_LIMIT") << answer.status.error_message();
  EXPECT_EQ(answer.metadata("setting"), "max-stream-cpu-s");
}

// Each of two clients has more long turns than there are threads for, and a third one comes.
TEST(Turns, OfTwoGreedyClientsKeepNoThirdOneFromHis) {
  constexpr int streams_of_each = 110;
  const Folder folder;
  const std::string socket = "unix:" + folder.path("socket");
  // Of memory there is enough for all of them.
  ServerProcess server({"--worker-threads", "2", "--max-selection-cpu-s", "0", "--drain-timeout-s",
                        "0", "--admin-listen", "127.0.0.1:0", "--memory-limit-mib", "8192",
                        "--max-session-memory-mib", "2048"},
                       "127.0.0.1:0,[::1]:0," + socket);
  const std::string log = server.log();
  const std::size_t second = log.find(',', log.find("\"ports\":"));
  ASSERT_NE(second, std::string::npos);
  const std::string third = "[::1]:" + std::to_string(std::stoi(log.substr(second + 1)));
  Busy busy;
  const std::string text = laps(100, removal);
  for (int i = 0; i < streams_of_each; ++i)
    for (const std::string& address : {server.address(), socket})
      busy.push_back(std::make_unique<LongStream>(channel_to(address), text));
  ASSERT_TRUE(eventually(
      [&] { return metric(server.admin(), "trc_streams_active") == 2 * streams_of_each; }, 60));
  std::this_thread::sleep_for(seconds(3));
  EXPECT_LT(longest_wait_s(third, 5), 10 * times_slower);
  // The third one's stream may be there for a moment more.
  EXPECT_TRUE(eventually(
      [&] { return metric(server.admin(), "trc_streams_active") == 2 * streams_of_each; }));
  server.signal(SIGTERM);
  server.wait();
}

}  // namespace
}  // namespace trc::faults
