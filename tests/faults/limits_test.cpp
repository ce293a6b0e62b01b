// The built server against clients that want more than it has: memory, time, places.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/session/program_session.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "server/resources/memory_account.h"
#include "tests/faults/control_group.h"
#include "tests/faults/questions.h"
#include "tests/faults/service_manager.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using server::StreamAnswer;
using std::chrono::seconds;
using testing_support::Folder;
using testing_support::memory_tells;
using testing_support::Process;
using testing_support::ServerProcess;
using testing_support::times_slower;
using Clock = std::chrono::steady_clock;

// Short lines, each a block: the most blocks for the bytes. A staircase, never closed.
std::string staircase(std::size_t bytes, const std::string& head) {
  std::string text = head + "G1 G41 V.G.WZ_AKT.R=0.01 X1 Y1 F800\nG91\n";
  while (text.size() < bytes) text += "X1\nY1\n";
  return text + "G40\nG1 X10 Y-10\nM30\n";
}

std::string compensated(const std::string& text) {
  ProgramSession session({});
  Answers out;
  EXPECT_TRUE(session.feed(text, out) && session.finish(out));
  return out.take().text;
}

// The whole program in one message, each client with a connection of its own.
std::vector<StreamAnswer> ask_at_once(const std::string& address, const std::string& text,
                                      int clients) {
  std::vector<std::future<StreamAnswer>> asked;
  for (int i = 0; i < clients; ++i)
    asked.push_back(std::async(std::launch::async,
                               [&] { return server::run_program(channel_to(address), {}, text); }));
  std::vector<StreamAnswer> answers;
  for (auto& one : asked) answers.push_back(one.get());
  return answers;
}

// Either all of it, or a refusal that names the limit and says when to come again. Returns how many
// were refused.
int refused_of(const std::vector<StreamAnswer>& answers, const std::string& expected) {
  int refused = 0;
  for (const StreamAnswer& answer : answers) {
    if (answer.status.ok()) {
      EXPECT_EQ(answer.text == expected, true);
      continue;
    }
    ++refused;
    EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED)
        << answer.status.error_message();
    EXPECT_EQ(answer.reason(), "MEMORY_LIMIT") << answer.status.error_message();
  }
  return refused;
}

// The container of deploy/README.md.
class SmallServer {
 public:
  SmallServer()
      : server_({"--admin-listen", "127.0.0.1:0", "--memory-limit-mib", "1024"}, "127.0.0.1:0", 0,
                {}, group_.launcher()) {}

  [[nodiscard]] ServerProcess& process() { return server_; }
  // What it held is given back, and it serves.
  void expect_recovers(double before_mib) {
    EXPECT_TRUE(
        eventually([&] { return metric(server_.admin(), "trc_session_memory_bytes") == 0; }));
    EXPECT_TRUE(eventually([&] { return server_.resident_mib() < before_mib + 150; }))
        << server_.resident_mib() << " MiB after " << before_mib;
    EXPECT_TRUE(serves(server_.address()));
  }

 private:
  MemoryGroup group_{std::uint64_t{1} << 30U};
  ServerProcess server_;
};

// 3 GB of blocks at once if nobody counted.
TEST(Limits, FourteenLargeMessagesDoNotKillASmallServer) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  SmallServer small;
  ASSERT_TRUE(serves(small.process().address()));
  const double before = small.process().resident_mib();
  for (const char* head : {"G141\n", "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]\n"}) {
    SCOPED_TRACE(head);
    const std::string text = staircase(863'000, head);
    const auto answers = ask_at_once(small.process().address(), text, 14);
    refused_of(answers, compensated(text));
    ASSERT_GT(small.process().resident_mib(), 0) << small.process().log();
    small.expect_recovers(before);
  }
}

// Nothing is held back there: what is certain leaves before the rest is taken.
TEST(Limits, FourteenLargeMessagesUnderG140AreAllAnswered) {
  SmallServer small;
  const std::string text = staircase(863'000, "");
  EXPECT_EQ(refused_of(ask_at_once(small.process().address(), text, 14), compensated(text)), 0);
}

TEST(Limits, SixtyStreamsDoNotKillASmallServer) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  SmallServer small;
  ASSERT_TRUE(serves(small.process().address()));
  const double before = small.process().resident_mib();
  const std::string text = staircase(107'000, "G141\n");
  refused_of(ask_at_once(small.process().address(), text, 60), compensated(text));
  small.expect_recovers(before);
}

// Steps of a micrometre with a tool of 100 mm: each block is near thousands of others.
TEST(Limits, TheTiniestStepsDoNotKillASmallServer) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  SmallServer small;
  ASSERT_TRUE(serves(small.process().address()));
  const double before = small.process().resident_mib();
  std::string text = "G141\nG1 G41 V.G.WZ_AKT.R=100 X1 Y1 F800\n";
  for (int i = 0; text.size() < 900'000; ++i)
    text += "X" + std::to_string(2 + 0.001 * i) + " Y" +
            std::to_string(1 + 0.3 * std::sin(0.001 * i)) + "\n";
  text += "G40\nG1 X-10 Y-100\nM30\n";
  for (const StreamAnswer& answer : ask_at_once(small.process().address(), text, 3))
    EXPECT_FALSE(answer.reason().empty()) << answer.status.error_message();
  small.expect_recovers(before);
}

// Arcs whose centre is a little off, each of which is told: ten bytes become a page of text.
std::string arcs_off_centre(std::size_t bytes) {
  std::string text = "G0 X0 Y0\nG1 F800\nG91\n";
  while (text.size() < bytes) text += "G2X2I1.02\n";
  return text + "M30\n";
}

TEST(Limits, AWarningOfEveryLineDoesNotKillASmallServer) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  SmallServer small;
  ASSERT_TRUE(serves(small.process().address()));
  const double before = small.process().resident_mib();
  const std::string text = arcs_off_centre(40'000);
  const std::size_t lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  for (const StreamAnswer& answer : ask_at_once(small.process().address(), text, 14)) {
    if (answer.status.ok())
      EXPECT_GE(answer.diagnostics.size() + 10, lines);
    else
      EXPECT_EQ(answer.reason(), "MEMORY_LIMIT") << answer.status.error_message();
  }
  small.expect_recovers(before);
}

// A block without a word takes two bytes on its way, and a hundred times as much as a message.
TEST(Limits, MessagesOfVeryManyBlocksDoNotKillASmallServer) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  SmallServer small;
  ASSERT_TRUE(serves(small.process().address()));
  const double before = small.process().resident_mib();
  v1::CompensatePathRequest batch;
  for (int i = 0; i < 500'000; ++i) batch.mutable_batch()->add_blocks();
  std::vector<std::future<StreamAnswer>> asked;
  for (int i = 0; i < 60; ++i)
    asked.push_back(std::async(std::launch::async, [&] {
      return server::call_path(channel_to(small.process().address()),
                               {server::setup_request(v1::PathSetup()), batch});
    }));
  for (auto& one : asked) {
    const StreamAnswer answer = one.get();
    EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED)
        << answer.status.error_message();
    EXPECT_NE(answer.reason(), "");
  }
  small.expect_recovers(before);
}

// What a client asks for does not pass what the server allows.
TEST(Limits, OfPassiveBlocksIsTheServersWhateverIsAskedFor) {
  const ServerProcess server({"--max-passive-blocks", "10"});
  std::string text = "G1 G41 V.G.WZ_AKT.R=0.5 X10 Y0 F800\n";
  for (int i = 0; i < 50; ++i) text += "M8\n";
  v1::ProgramSetup setup;
  setup.mutable_path()->set_max_passive_blocks(10'000);
  const StreamAnswer answer =
      server::run_program(channel_to(server.address()), setup, text + "X30\nG40\nX0 Y-9\nM30\n");
  EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT) << answer.status.error_message();
  EXPECT_NE(answer.status.error_message().find("90011"), std::string::npos)
      << answer.status.error_message();
  EXPECT_NE(answer.status.error_message().find("10"), std::string::npos)
      << answer.status.error_message();
}

// As the help of 90011 says it; and in other dialects than ISG nobody need ask.
TEST(Limits, OfPassiveBlocksIsWhatTheSetupAsksFor) {
  const ServerProcess server;
  std::string text = "G1 G41 V.G.WZ_AKT.R=0.5 X10 Y0 F800\n";
  for (int i = 0; i < 150; ++i) text += "M8\n";
  text += "X30\nG40\nX0 Y-9\nM30\n";
  const auto channel = channel_to(server.address());
  v1::ProgramSetup setup;
  EXPECT_NE(server::run_program(channel, setup, text).status.error_message().find("90011"),
            std::string::npos);
  setup.mutable_path()->set_max_passive_blocks(200);
  const StreamAnswer raised = server::run_program(channel, setup, text);
  EXPECT_TRUE(raised.status.ok()) << raised.status.error_message();

  v1::ProgramSetup fanuc;
  fanuc.set_dialect(v1::DIALECT_FANUC);
  fanuc.mutable_path()->set_tool_radius(0.5);
  text.replace(text.find("V.G.WZ_AKT.R=0.5"), 16, "D1");
  const StreamAnswer other = server::run_program(channel, fanuc, text);
  EXPECT_TRUE(other.status.ok()) << other.status.error_message();
}

grpc::health::v1::HealthCheckResponse::ServingStatus health_of(const std::string& address) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(10));
  grpc::health::v1::HealthCheckResponse response;
  grpc::health::v1::Health::NewStub(channel_to(address))->Check(&context, {}, &response);
  return response.status();
}

// gRPC gives work to threads that could not be made, and the pool makes one for a turn that gives
// way: neither leaves a client without an answer, nor keeps the server from its end. What it says
// of itself is what its clients see.
TEST(Limits, NoFurtherThreadIsNeededToAnswer) {
  if (!memory_tells) GTEST_SKIP() << "the reserve is not taken under a sanitizer";
  const ThreadGroup group(1000);
  if (!group.exists()) GTEST_SKIP() << "no cgroup can be made here";
  const Folder folder;
  ServiceManager manager(folder.path("notify"));
  ServerProcess server(
      {"--admin-listen", "127.0.0.1:0", "--http-listen", "127.0.0.1:0"}, "127.0.0.1:0", 0,
      {"NOTIFY_SOCKET=" + folder.path("notify"), "WATCHDOG_USEC=1000000"}, group.launcher());
  ASSERT_TRUE(serves(server.address()));
  ASSERT_TRUE(group.set_limit(static_cast<std::uint64_t>(server.threads())));
  // Held back until its end, and answered as it comes.
  for (const std::string& text : {staircase(300'000, "G141\n"), staircase(900'000, "")}) {
    const std::string expected = compensated(text);
    for (const StreamAnswer& answer : ask_at_once(server.address(), text, 8)) {
      EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
      EXPECT_EQ(answer.text == expected, true);
    }
  }
  EXPECT_GT(metric(server.admin(), "trc_pool_threads_missed_total"), 0);
  EXPECT_EQ(testing_support::http_get(server.admin(), "/readyz"), "ready\n");
  EXPECT_EQ(health_of(server.address()), grpc::health::v1::HealthCheckResponse::SERVING);
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0) << server.log() << server.errors();
}

// Where the reserve is used up: the server ends, so that its clients go on elsewhere, before
// anybody has waited long; health said so, or was asked no more.
TEST(Limits, WhoGoesWithoutAThreadIsNotLeftWaiting) {
  if (!memory_tells) GTEST_SKIP() << "the reserve is not taken under a sanitizer";
  const ThreadGroup group(1000);
  if (!group.exists()) GTEST_SKIP() << "no cgroup can be made here";
  ServerProcess server({"--admin-listen", "127.0.0.1:0", "--drain-timeout-s", "2"}, "127.0.0.1:0",
                       0, {}, group.launcher());
  ASSERT_TRUE(serves(server.address()));
  // Fewer than there are: nothing that ends may be replaced.
  ASSERT_TRUE(group.set_limit(static_cast<std::uint64_t>(server.threads()) / 2));
  const std::string text = staircase(900'000, "");
  const std::string expected = compensated(text);
  const auto begin = Clock::now();
  for (int round = 0; round < 3; ++round)
    for (const StreamAnswer& answer : ask_at_once(server.address(), text, 16))
      EXPECT_TRUE(answer.status.ok() ? answer.text == expected
                                     : !answer.status.error_message().empty());
  EXPECT_LT(Clock::now() - begin, seconds(60));
  const std::string ready = testing_support::http_get(server.admin(), "/readyz");
  const bool is_serving =
      health_of(server.address()) == grpc::health::v1::HealthCheckResponse::SERVING;
  EXPECT_TRUE(ready != "ready\n" || (is_serving && serves(server.address()))) << ready;
  server.signal(SIGTERM);
  const bool went_without = server.log().find("threads_missing") != std::string::npos;
  EXPECT_EQ(server.wait(), went_without ? 1 : 0) << server.log() << server.errors();
}

TEST(Limits, TooFewThreadsAreSaidBeforeAPortOpens) {
  if (!memory_tells) GTEST_SKIP() << "the reserve is not taken under a sanitizer";
  const ThreadGroup group(12);
  if (!group.exists()) GTEST_SKIP() << "no cgroup can be made here";
  std::vector<std::string> command = group.launcher();
  command.insert(command.end(), {testing_support::trcd_program(), "--listen", "127.0.0.1:0"});
  const auto said = testing_support::run(command);
  EXPECT_EQ(said.code, 1);
  EXPECT_NE(said.err.find("too few threads"), std::string::npos) << said.err;
}

TEST(Limits, TheLimitOfTheGroupIsFound) {
  const MemoryGroup group(std::uint64_t{512} << 20U);
  if (!group.exists()) GTEST_SKIP() << "no cgroup can be made here";
  const ServerProcess server({}, "127.0.0.1:0", 0, {}, group.launcher());
  EXPECT_NE(server.log().find("\"memory_limit_mib\":512"), std::string::npos) << server.log();
  EXPECT_NE(server.log().find("\"max_session_memory_mib\":256"), std::string::npos);
}

TEST(Limits, SumsThatDoNotFitAreRefusedBeforeAPortOpens) {
  const auto buffers =
      testing_support::run({testing_support::trcd_program(), "--listen", "127.0.0.1:0",
                            "--max-streams", "1000", "--max-grpc-buffer-mib", "96"});
  EXPECT_EQ(buffers.code, 2);
  EXPECT_NE(buffers.err.find("max-grpc-buffer-mib"), std::string::npos) << buffers.err;
  const auto memory =
      testing_support::run({testing_support::trcd_program(), "--listen", "127.0.0.1:0",
                            "--memory-limit-mib", "512", "--max-session-memory-mib", "500"});
  EXPECT_EQ(memory.code, 2);
  EXPECT_NE(memory.err.find("memory-limit-mib"), std::string::npos) << memory.err;
}

// The client library comes again when it is told to.
TEST(Limits, ClientsWaitForAPlace) {
  // All come at once, and connect within the time that gRPC gives them.
  constexpr int clients = times_slower < 20 ? 40 : 8;
  const Folder folder;
  const std::string text = staircase(20'000, "");
  const std::string file = folder.write("program.nc", text);
  const ServerProcess server({"--max-streams", "3", "--max-streams-per-peer", "3"});
  std::vector<std::unique_ptr<Process>> processes;
  for (int i = 0; i < clients; ++i)
    processes.push_back(std::make_unique<Process>(std::vector<std::string>{
        FAULT_CLIENT, server.address(), file, folder.path(std::to_string(i)), "20"}));
  const std::string expected = compensated(text);
  for (int i = 0; i < clients; ++i) {
    EXPECT_EQ(processes[static_cast<std::size_t>(i)]->wait(), 0)
        << processes[static_cast<std::size_t>(i)]->err();
    EXPECT_EQ(testing_support::content_of(folder.path(std::to_string(i))) == expected, true);
  }
}

// One peer comes through the port, the other one through the socket file.
TEST(Limits, OnePeerCannotTakeAllPlaces) {
  const Folder folder;
  const std::string socket = "unix:" + folder.path("socket");
  const ServerProcess server({"--max-streams", "8"}, "127.0.0.1:0," + socket);
  const auto channel = channel_to(server.address());
  const auto stub = v1::TrcService::NewStub(channel);
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  using Open =
      grpc::ClientReaderWriter<v1::CompensateProgramRequest, v1::CompensateProgramResponse>;
  std::vector<std::unique_ptr<Open>> open;
  int accepted = 0;
  for (int i = 0; i < 10; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    open.push_back(stub->CompensateProgram(contexts.back().get()));
    open.back()->Write(server::setup_request(v1::ProgramSetup()));
    v1::CompensateProgramResponse response;
    if (open.back()->Read(&response) && response.has_accepted()) ++accepted;
  }
  EXPECT_EQ(accepted, 6);
  const StreamAnswer refused = server::run_program(channel, {}, server::g239_program);
  EXPECT_EQ(refused.reason(), "STREAM_LIMIT");
  EXPECT_EQ(refused.metadata("max_streams_per_peer"), "6");
  EXPECT_TRUE(serves(socket));
  for (const auto& context : contexts) context->TryCancel();
  for (const auto& stream : open) stream->Finish();
  EXPECT_TRUE(eventually([&] { return serves(server.address()); }));
}

TEST(Limits, OnePeerCannotTakeAllMemory) {
  if (!server::counts_heap) GTEST_SKIP() << "the heap is not counted under ThreadSanitizer";
  const Folder folder;
  const std::string socket = "unix:" + folder.path("socket");
  const ServerProcess server({"--max-session-memory-mib", "64", "--max-memory-per-peer-mib", "16"},
                             "127.0.0.1:0," + socket);
  const std::string text = staircase(300'000, "G141\n");
  const StreamAnswer refused = server::run_program(channel_to(server.address()), {}, text);
  EXPECT_EQ(refused.reason(), "MEMORY_LIMIT");
  EXPECT_NE(refused.status.error_message().find("max-memory-per-peer-mib"), std::string::npos)
      << refused.status.error_message();
  EXPECT_TRUE(serves(socket));
}

}  // namespace
}  // namespace trc::faults
