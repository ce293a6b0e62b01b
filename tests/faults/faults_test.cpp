// The built server under faults, from outside: processes that die, clients that misbehave.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/session/program_session.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "tests/faults/questions.h"
#include "tests/faults/raw_connection.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using server::StreamAnswer;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::Folder;
using testing_support::memory_tells;
using testing_support::Process;
using testing_support::ServerProcess;

std::string program(int turns, const std::string& head = "") {
  std::string text = head + "N5 G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800\n";
  for (int turn = 0; turn < turns; ++turn) {
    const int x = 20 * (turn % 4000);
    const int y = 10 + turn * 7 % 11;
    text += "G1 X" + std::to_string(x + 5) + " Y" + std::to_string(y) + "\nX" +
            std::to_string(x + 10) + "\nG2 X" + std::to_string(x + 16) + " I3 J0\nM8\n";
    if (turn % 4000 == 3999) text += "G1 Y200\nX-50\nY10\n";
  }
  return text + "G40\nG1 X0 Y-100\nM30\n";
}

std::string compensated(const std::string& text) {
  ProgramSession session({});
  Answers out;
  EXPECT_TRUE(session.feed(text, out) && session.finish(out));
  return out.take().text;
}

class Client {
 public:
  Client(const Folder& folder, const std::string& name, const std::string& address,
         const std::string& program_file, int pause_ms)
      : output_(folder.path(name)),
        process_({FAULT_CLIENT, address, program_file, output_, std::to_string(pause_ms)}) {}

  [[nodiscard]] bool has_begun() { return process_.out().find("begun") != std::string::npos; }
  [[nodiscard]] std::string output() const { return testing_support::content_of(output_); }
  [[nodiscard]] Process& process() { return process_; }

 private:
  std::string output_;
  Process process_;
};

TEST(Faults, KilledServerIsReplacedAndTheOutputIsTheSame) {
  const Folder folder;
  const std::string text = program(4000);
  const std::string file = folder.write("program.nc", text);
  const std::string key = folder.path("key");
  auto server = std::make_unique<ServerProcess>(std::vector<std::string>{"--resume-key-file", key});
  const std::string address = server->address();
  Client client(folder, "out.nc", address, file, 30);
  ASSERT_TRUE(eventually([&] { return client.has_begun(); }));
  for (int round = 0; round < 3; ++round) {
    std::this_thread::sleep_for(milliseconds(200));
    server->signal(SIGKILL);
    server.reset();
    server = std::make_unique<ServerProcess>(std::vector<std::string>{"--resume-key-file", key},
                                             address);
    ASSERT_EQ(server->address(), address);
  }
  EXPECT_EQ(client.process().wait(), 0) << client.process().err();
  EXPECT_EQ(client.process().out().find("resumed 0"), std::string::npos);
  EXPECT_EQ(client.output(), compensated(text));
}

// Under G141 the whole selection is held back: here some hundred thousand blocks.
TEST(Faults, MemoryOfAKilledClientIsBackWithinSeconds) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  const Folder folder;
  ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  ASSERT_TRUE(serves(server.address()));
  const double before = server.resident_mib();
  const auto held = [&] { return metric(server.admin(), "trc_session_memory_bytes"); };
  struct Case {
    const char* removal;
    int blocks;
    double held_bytes;
  };
  for (const auto& [removal, blocks, held_bytes] :
       {Case{"", 100'000, 200e6}, Case{"#TRC[REMOVE_MASKED_BLOCKS=1]\n", 500'000, 60e6}}) {
    SCOPED_TRACE(removal);
    Client client(folder, "out.nc", server.address(),
                  folder.write("program.nc", program(blocks, std::string("G141\n") + removal)), 0);
    ASSERT_TRUE(eventually([&held, least = held_bytes] { return held() > least; }));
    EXPECT_EQ(metric(server.admin(), "trc_streams_active"), 1);
    const double most = server.resident_mib();
    client.process().signal(SIGKILL);
    EXPECT_TRUE(eventually(
        [&] {
          return held() == 0 && metric(server.admin(), "trc_streams_active") == 0 &&
                 server.resident_mib() - before < 0.25 * (most - before);
        },
        5))
        << held() << " bytes held, " << server.resident_mib() << " MiB of " << most << ", "
        << before << " before";
  }
  EXPECT_TRUE(serves(server.address()));
}

TEST(Faults, DrainLosesNothing) {
  const Folder folder;
  const std::string text = program(1500);
  const std::string file = folder.write("program.nc", text);
  ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 4; ++i)
    clients.push_back(
        std::make_unique<Client>(folder, "out" + std::to_string(i), server.address(), file, 20));
  for (auto& client : clients) ASSERT_TRUE(eventually([&] { return client->has_begun(); }));
  // A client has begun before the server knows of it.
  ASSERT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 4; }));
  server.signal(SIGTERM);
  for (auto& client : clients) {
    EXPECT_EQ(client->process().wait(), 0) << client->process().err();
    EXPECT_EQ(client->process().out().find("resumed 0") == std::string::npos, false);
    EXPECT_EQ(client->output(), compensated(text));
  }
  EXPECT_EQ(server.wait(), 0);
  EXPECT_NE(server.log().find("\"streams_cut_off\":0"), std::string::npos);
}

TEST(Faults, SecondSignalEndsAtOnce) {
  const Folder folder;
  ServerProcess server;
  Client client(folder, "out", server.address(), folder.write("program.nc", program(4000)), 50);
  ASSERT_TRUE(eventually([&] { return client.has_begun(); }));
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] { return server.log().find("\"draining\"") != std::string::npos; }));
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 1);
  client.process().signal(SIGKILL);
}

TEST(Faults, TakenPortIsAnError) {
  ServerProcess server;
  const auto second =
      testing_support::run({testing_support::trcd_program(), "--listen", server.address()});
  EXPECT_EQ(second.code, 1);
  EXPECT_EQ(second.err,
            "trcd: error: cannot listen on " + server.address() + ": the address is in use\n");
}

// Writes and never reads, not even the headers of the answer.
class DeafStream final
    : public grpc::ClientBidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse> {
 public:
  explicit DeafStream(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(v1::TrcService::NewStub(channel)) {
    request_.mutable_setup()->set_tool_radius(1);
    stub_->async()->CompensatePath(&context_, this);
    StartWrite(&request_);
    StartCall();
  }
  ~DeafStream() override {
    context_.TryCancel();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_; });
  }
  DeafStream(const DeafStream&) = delete;
  DeafStream& operator=(const DeafStream&) = delete;

  [[nodiscard]] int written() const { return written_; }

 private:
  void OnWriteDone(bool ok) override {
    if (!ok) return;
    ++written_;
    v1::BlockBatch& batch = *request_.mutable_batch();
    const std::uint64_t first =
        batch.first_block() + static_cast<std::uint64_t>(batch.blocks_size());
    batch.Clear();
    batch.set_first_block(first);
    for (int i = 0; i < 500; ++i)
      *batch.add_blocks() = server::line_to(static_cast<double>(i), written_ % 7);
    StartWrite(&request_);
  }
  void OnDone(const grpc::Status& /*status*/) override {
    const std::lock_guard lock(mutex_);
    done_ = true;
    changed_.notify_all();
  }

  std::unique_ptr<v1::TrcService::Stub> stub_;
  grpc::ClientContext context_;
  v1::CompensatePathRequest request_;
  std::atomic<int> written_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
};

TEST(Faults, ClientsThatNeverReadAreBounded) {
  if (!memory_tells) GTEST_SKIP() << "not under a sanitizer";
  constexpr int streams = 200;
  constexpr int per_connection = 50;
  constexpr double quota_mib = 96;
  constexpr double allowance_mib = 64;
  ServerProcess server({"--admin-listen", "127.0.0.1:0", "--max-grpc-buffer-mib",
                        std::to_string(static_cast<int>(quota_mib)), "--max-message-bytes",
                        "65536"});
  ASSERT_TRUE(serves(server.address()));
  const double before = server.resident_mib();
  std::vector<std::unique_ptr<DeafStream>> deaf;
  std::shared_ptr<grpc::Channel> channel;
  for (int i = 0; i < streams; ++i) {
    if (i % per_connection == 0) channel = channel_to(server.address());
    deaf.push_back(std::make_unique<DeafStream>(channel));
  }
  const auto written = [&] {
    int sum = 0;
    for (const auto& stream : deaf) sum += stream->written();
    return sum;
  };
  // Until nothing moves any more.
  int last = -1;
  for (int round = 0; round < 60 && written() != last; ++round) {
    last = written();
    std::this_thread::sleep_for(milliseconds(500));
    EXPECT_LT(server.resident_mib() - before, quota_mib + allowance_mib);
  }
  EXPECT_GT(written(), streams);
  EXPECT_TRUE(serves(server.address()));
  deaf.clear();
  EXPECT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 0; }));
}

// Descriptors are kept for those who ask whether the server is well.
TEST(Faults, HealthAnswersWhenDescriptorsHaveRunOut) {
  ServerProcess server({"--admin-listen", "127.0.0.1:0", "--health-listen", "127.0.0.1:0",
                        "--max-connections-per-peer", "1000"},
                       "127.0.0.1:0", 80);
  std::vector<std::unique_ptr<RawConnection>> burst;
  for (int i = 0; i < 200; ++i) burst.push_back(std::make_unique<RawConnection>(server.address()));
  ASSERT_TRUE(
      eventually([&] { return metric(server.admin(), "trc_connections_refused_total") > 0; }));
  // What the server opens for a moment, as for the page just read, leaves room for one more.
  ASSERT_TRUE(eventually([&] {
    burst.push_back(std::make_unique<RawConnection>(server.address()));
    return !serves(server.address());
  }));
  grpc::ClientContext context;
  const grpc::health::v1::HealthCheckRequest request;
  grpc::health::v1::HealthCheckResponse response;
  const grpc::Status status = grpc::health::v1::Health::NewStub(channel_to(server.health()))
                                  ->Check(&context, request, &response);
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(response.status(), grpc::health::v1::HealthCheckResponse::SERVING);
}

// CVE-2023-4785: gRPC's own listener stays deaf after this.
TEST(Faults, ListenerSurvivesRunningOutOfDescriptors) {
  ServerProcess server({"--admin-listen", "127.0.0.1:0", "--max-connections-per-peer", "1000"},
                       "127.0.0.1:0", 80);
  ASSERT_FALSE(server.address().empty());
  const auto open_before = channel_to(server.address());
  ASSERT_TRUE(server::run_program(open_before, {}, server::g239_program).status.ok());
  const auto refused = [&] { return metric(server.admin(), "trc_connections_refused_total"); };
  for (int round = 0; round < 3; ++round) {
    const double refused_before = refused();
    ASSERT_GE(refused_before, 0);
    std::vector<std::unique_ptr<RawConnection>> burst;
    for (int i = 0; i < 200; ++i)
      burst.push_back(std::make_unique<RawConnection>(server.address()));
    // A slow server would find them gone, and its descriptors never used up.
    ASSERT_TRUE(eventually([&] { return refused() > refused_before; }));
    // Who is connected is served meanwhile.
    EXPECT_TRUE(server::run_program(open_before, {}, server::g239_program).status.ok());
    burst.clear();
    EXPECT_TRUE(eventually([&] { return serves(server.address()); }));
  }
  EXPECT_TRUE(eventually(
      [&] { return server.log().find("\"connections_refused\"") != std::string::npos; }));
}

TEST(Faults, DribblingClientsDisturbNobody) {
  ServerProcess server;
  constexpr std::string_view preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
  std::vector<std::unique_ptr<RawConnection>> dribbling;
  for (int i = 0; i < 50; ++i)
    dribbling.push_back(std::make_unique<RawConnection>(server.address()));
  for (const char byte : preface) {
    for (const auto& connection : dribbling) connection->send_bytes({&byte, 1});
    if (byte == '*') {
      EXPECT_TRUE(serves(server.address()));
    }
  }
  EXPECT_TRUE(serves(server.address()));
}

TEST(Faults, OversizedMetadataIsRefused) {
  ServerProcess server;
  const auto channel = channel_to(server.address());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(20));
  context.AddMetadata("x-large", std::string(64 * 1024, 'x'));
  v1::GetServerInfoResponse info;
  const grpc::Status status = v1::TrcService::NewStub(channel)->GetServerInfo(&context, {}, &info);
  EXPECT_EQ(status.error_code(), grpc::RESOURCE_EXHAUSTED) << status.error_message();
  // The connection may be given up, not the server.
  EXPECT_TRUE(eventually(
      [&] { return server::run_program(channel, {}, server::g239_program).status.ok(); }));
}

// An accepted stream that waits.
class WaitingStream final
    : public grpc::ClientBidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse> {
 public:
  explicit WaitingStream(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(v1::TrcService::NewStub(channel)) {
    request_.mutable_setup()->set_tool_radius(1);
    stub_->async()->CompensatePath(&context_, this);
    StartRead(&response_);
    StartWrite(&request_);
    StartCall();
  }
  ~WaitingStream() override {
    context_.TryCancel();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_; });
  }
  WaitingStream(const WaitingStream&) = delete;
  WaitingStream& operator=(const WaitingStream&) = delete;

  [[nodiscard]] bool accepted() const { return accepted_; }
  [[nodiscard]] bool ended() {
    const std::lock_guard lock(mutex_);
    return done_;
  }
  [[nodiscard]] grpc::Status status() {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  void OnReadDone(bool ok) override { accepted_ = ok && response_.has_accepted(); }
  void OnDone(const grpc::Status& status) override {
    const std::lock_guard lock(mutex_);
    status_ = status;
    done_ = true;
    changed_.notify_all();
  }

  std::unique_ptr<v1::TrcService::Stub> stub_;
  grpc::ClientContext context_;
  v1::CompensatePathRequest request_;
  v1::CompensatePathResponse response_;
  std::atomic<bool> accepted_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  grpc::Status status_;
};

TEST(Faults, ThousandsOfStreamsAndTheLimitOfThem) {
  constexpr int most = 10'000;
  constexpr int per_connection = most / 10;
  ServerProcess server({"--max-streams", std::to_string(most), "--max-streams-per-connection",
                        std::to_string(per_connection), "--max-streams-per-peer",
                        std::to_string(most), "--max-message-bytes", "32768",
                        "--max-grpc-buffer-mib", "625", "--heartbeat-s", "0"});
  std::vector<std::unique_ptr<WaitingStream>> streams;
  std::shared_ptr<grpc::Channel> channel;
  for (int i = 0; i < most; ++i) {
    if (i % per_connection == 0) channel = channel_to(server.address());
    streams.push_back(std::make_unique<WaitingStream>(channel));
  }
  EXPECT_TRUE(eventually(
      [&] {
        return std::all_of(streams.begin(), streams.end(),
                           [](const auto& stream) { return stream->accepted(); });
      },
      60));
  WaitingStream one_more(channel_to(server.address()));
  ASSERT_TRUE(eventually([&] { return one_more.ended(); }));
  EXPECT_EQ(one_more.status().error_code(), grpc::RESOURCE_EXHAUSTED);
  streams.clear();
  EXPECT_TRUE(eventually([&] { return serves(server.address()); }));
}

}  // namespace
}  // namespace trc::faults
