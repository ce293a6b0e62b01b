#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "grpc/health/v1/health.grpc.pb.h"
#include "server/resources/memory_account.h"
#include "server/server.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Config loopback() {
  Config config;
  config.listen = {"127.0.0.1:0"};
  config.log_level = "off";
  config.drain_timeout_s = 20;
  return config;
}

// A server at a free port of the loopback interface.
struct Running {
  explicit Running(const Config& config) : server(Server::start(config).server) {
    address = "127.0.0.1:" + std::to_string(server->ports().front());
  }
  [[nodiscard]] std::shared_ptr<grpc::Channel> channel() const {
    return grpc::CreateChannel(address, grpc::InsecureChannelCredentials());
  }

  std::unique_ptr<Server> server;
  std::string address;
};

// A stream that has been accepted and stays open.
class Open {
 public:
  // `forwarded`: what proxies on the way say of the client.
  explicit Open(const std::shared_ptr<grpc::Channel>& channel,
                const std::vector<std::string>& forwarded = {})
      : stub_(v1::TrcService::NewStub(channel)) {
    for (const std::string& addresses : forwarded)
      context_.AddMetadata("x-forwarded-for", addresses);
    context_.set_deadline(std::chrono::system_clock::now() + seconds(60));
    stream_ = stub_->CompensatePath(&context_);
    stream_->Write(setup_request(v1::PathSetup()));
    accepted_ = stream_->Read(&response_) && response_.has_accepted();
  }

  [[nodiscard]] bool accepted() const { return accepted_; }
  grpc::ClientContext& context() { return context_; }

  bool send(const v1::CompensatePathRequest& request) { return stream_->Write(request); }
  // Ends the path; the status of the stream.
  grpc::Status finish() {
    stream_->Write(batch(0, {line_to(1, 1)}, true));
    return end();
  }
  grpc::Status end() {
    stream_->WritesDone();
    while (stream_->Read(&response_)) {
    }
    return stream_->Finish();
  }

 private:
  std::unique_ptr<v1::TrcService::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::CompensatePathRequest, v1::CompensatePathResponse>>
      stream_;
  v1::CompensatePathResponse response_;
  bool accepted_ = false;
};

std::string reason_of(const grpc::Status& status) {
  StreamAnswer answer;
  answer.status = status;
  return answer.reason();
}

grpc::health::v1::HealthCheckResponse::ServingStatus health_of(
    const std::shared_ptr<grpc::Channel>& channel, const std::string& service) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(20));
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(service);
  grpc::health::v1::HealthCheckResponse response;
  const auto status =
      grpc::health::v1::Health::NewStub(channel)->Check(&context, request, &response);
  return status.ok() ? response.status() : grpc::health::v1::HealthCheckResponse::SERVICE_UNKNOWN;
}

constexpr auto serving = grpc::health::v1::HealthCheckResponse::SERVING;
constexpr auto not_serving = grpc::health::v1::HealthCheckResponse::NOT_SERVING;

TEST(Server, ComputesOverALoopbackPort) {
  const Running running(loopback());
  const StreamAnswer answer = run_program(running.channel(), blocks_setup(), g239_program);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_NE(answer.listing().find("PROGRAMMED 90 30 -> 120 30"), std::string::npos);
}

TEST(Server, ComputesOverAUnixSocket) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("trcd_" + std::to_string(getpid()) + ".sock"))
          .string();
  Config config = loopback();
  config.listen = {"unix:" + path};
  {
    const auto started = Server::start(config);
    ASSERT_NE(started.server, nullptr) << started.fault;
    const auto channel = grpc::CreateChannel("unix:" + path, grpc::InsecureChannelCredentials());
    EXPECT_TRUE(run_program(channel, {}, g239_program).status.ok());
    // Nobody takes over the address of a living server.
    EXPECT_NE(Server::start(config).fault.find("another server"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Server, TakesAStaleUnixSocket) {
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("trcd_stale_" + std::to_string(getpid()) + ".sock"))
                               .string();
  Config config = loopback();
  config.listen = {"unix:" + path};
  // What a killed server leaves behind.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  const int dead = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  close(dead);
  ASSERT_TRUE(std::filesystem::exists(path));
  EXPECT_NE(Server::start(config).server, nullptr);
}

TEST(Server, PortInUseIsAFault) {
  const Running running(loopback());
  Config config = loopback();
  config.listen = {running.address};
  const auto second = Server::start(config);
  EXPECT_EQ(second.server, nullptr);
  EXPECT_NE(second.fault.find(running.address), std::string::npos) << second.fault;
  EXPECT_EQ(second.fault.find('\n'), std::string::npos);
}

TEST(Server, SaysThatItServes) {
  const Running running(loopback());
  const auto channel = running.channel();
  EXPECT_EQ(health_of(channel, ""), serving);
  EXPECT_EQ(health_of(channel, "trc.v1.TrcService"), serving);
  EXPECT_EQ(health_of(channel, "trc.v1.Nothing"),
            grpc::health::v1::HealthCheckResponse::SERVICE_UNKNOWN);
}

TEST(Server, DrainLetsOpenStreamsFinishAndTakesNoNewOnes) {
  const Running running(loopback());
  const auto channel = running.channel();
  Open open(channel);
  ASSERT_TRUE(open.accepted());

  std::atomic<bool> drained = false;
  std::size_t cut_off = 99;
  std::thread drainer([&] {
    cut_off = running.server->drain();
    drained = true;
  });
  ASSERT_TRUE(eventually([&] { return running.server->backend().streams.draining(); }));
  EXPECT_TRUE(eventually([&] { return health_of(channel, "trc.v1.TrcService") == not_serving; }));
  EXPECT_EQ(health_of(channel, ""), not_serving);

  const StreamAnswer refused = run_program(channel, {}, g239_program);
  EXPECT_EQ(refused.status.error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(refused.reason(), "SERVER_DRAINING");
  EXPECT_FALSE(drained);

  EXPECT_TRUE(open.finish().ok());
  drainer.join();
  EXPECT_EQ(cut_off, 0U);
}

TEST(Server, DrainWithNothingOpenIsQuick) {
  const Running running(loopback());
  const auto channel = running.channel();
  EXPECT_EQ(health_of(channel, ""), serving);  // an idle client stays connected
  const auto begin = Clock::now();
  EXPECT_EQ(running.server->drain(), 0U);
  EXPECT_LT(Clock::now() - begin, seconds(5));
}

TEST(Server, DrainCutsOffWhatDoesNotFinishInTime) {
  Config config = loopback();
  config.drain_timeout_s = 1;
  const Running running(config);
  Open open(running.channel());
  ASSERT_TRUE(open.accepted());
  const auto begin = Clock::now();
  EXPECT_EQ(running.server->drain(), 1U);
  EXPECT_LT(Clock::now() - begin, seconds(15));
  const grpc::Status status = open.end();
  EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(reason_of(status), "DRAIN_TIMEOUT");
}

TEST(Server, StreamsBeyondTheLimitAreRefusedUntilOneEnds) {
  Config config = loopback();
  config.max_streams = 2;
  config.max_streams_per_peer = 10;
  const Running running(config);
  const auto channel = running.channel();
  Open first(channel);
  Open second(channel);
  ASSERT_TRUE(first.accepted() && second.accepted());

  const StreamAnswer refused = run_program(channel, {}, g239_program);
  EXPECT_EQ(refused.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(refused.reason(), "STREAM_LIMIT");
  EXPECT_EQ(refused.metadata("max_streams"), "2");

  EXPECT_TRUE(first.finish().ok());
  ASSERT_TRUE(eventually([&] { return running.server->backend().streams.count() == 1; }));
  EXPECT_TRUE(run_program(channel, {}, g239_program).status.ok());
}

TEST(Server, ClientsOfATrustedProxyHaveLimitsOfTheirOwn) {
  Config config = loopback();
  config.max_streams_per_peer = 1;
  config.trusted_proxies = {"192.0.2.1", "127.0.0.0/8"};
  const Running running(config);
  const auto channel = running.channel();
  const Open mill(channel, {"192.0.2.7"});
  EXPECT_TRUE(mill.accepted());
  // What the client itself says comes before the address that the proxy sees.
  for (const std::vector<std::string>& forwarded : {std::vector<std::string>{"192.0.2.7"},
                                                    {"192.0.2.9, 192.0.2.7"},
                                                    {"192.0.2.9", "192.0.2.7"}}) {
    Open again(channel, forwarded);
    EXPECT_FALSE(again.accepted());
    EXPECT_EQ(reason_of(again.end()), "STREAM_LIMIT");
  }
  EXPECT_TRUE(Open(channel, {"192.0.2.8"}).accepted());
  const Open ipv6(channel, {"2001:db8:1:2::3"});
  EXPECT_TRUE(ipv6.accepted());
  EXPECT_FALSE(Open(channel, {"2001:db8:1:2:3::4"}).accepted());
  // The proxy itself, and whoever it does not name.
  const Open proxy(channel);
  EXPECT_TRUE(proxy.accepted());
  EXPECT_FALSE(Open(channel, {"unknown"}).accepted());
}

TEST(Server, NobodyElseNamesTheClient) {
  Config config = loopback();
  config.max_streams_per_peer = 1;
  for (const std::vector<std::string>& proxies :
       {std::vector<std::string>{}, {"192.0.2.1", "127.0.0.2", "::1", "126.0.0.0/8"}}) {
    config.trusted_proxies = proxies;
    const Running running(config);
    const auto channel = running.channel();
    const Open mill(channel, {"192.0.2.7"});
    EXPECT_TRUE(mill.accepted());
    EXPECT_FALSE(Open(channel, {"192.0.2.8"}).accepted());
  }
}

// HTTP/2 tells the client how many it may have; its library holds the others back.
TEST(Server, StreamsBeyondTheLimitOfAConnectionWaitForTheirTurn) {
  Config config = loopback();
  config.max_streams_per_connection = 2;
  const Running running(config);
  const auto channel = running.channel();
  Open first(channel);
  Open second(channel);
  ASSERT_TRUE(first.accepted() && second.accepted());
  const auto stub = v1::TrcService::NewStub(channel);
  v1::GetServerInfoResponse info;
  grpc::ClientContext waits;
  waits.set_deadline(std::chrono::system_clock::now() + milliseconds(200));
  EXPECT_EQ(stub->GetServerInfo(&waits, {}, &info).error_code(), grpc::DEADLINE_EXCEEDED);
  EXPECT_TRUE(first.finish().ok());
  grpc::ClientContext gets_in;
  EXPECT_TRUE(stub->GetServerInfo(&gets_in, {}, &info).ok());
  EXPECT_TRUE(second.finish().ok());
}

TEST(Server, PassiveBlocksBeyondTheLimitAreRefused) {
  Config config = loopback();
  config.max_passive_blocks = 3;
  const Running running(config);
  const StreamAnswer answer = run_program(
      running.channel(), {}, "G41 V.G.WZ_AKT.R=1 G1 X10 F100\nX20\nM8\nM9\nM8\nM9\nX30\n");
  EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(answer.metadata("code"), "90011");
  EXPECT_EQ(answer.metadata("limit"), "3");
}

TEST(Server, CancelledStreamGivesItsPlaceBack) {
  const Running running(loopback());
  Open open(running.channel());
  ASSERT_TRUE(open.accepted());
  EXPECT_EQ(running.server->backend().streams.count(), 1U);
  open.context().TryCancel();
  EXPECT_TRUE(eventually([&] { return running.server->backend().streams.count() == 0; }));
  EXPECT_EQ(open.end().error_code(), grpc::CANCELLED);
}

TEST(Server, IdleStreamIsEnded) {
  Config config = loopback();
  config.idle_timeout_s = 1;
  const Running running(config);
  Open open(running.channel());
  ASSERT_TRUE(open.accepted());
  ASSERT_TRUE(eventually([&] { return running.server->backend().streams.count() == 0; }));
  const grpc::Status status = open.end();
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  EXPECT_EQ(reason_of(status), "STREAM_IDLE");
}

TEST(Server, ClientThatNeverReadsIsEndedToo) {
  Config config = loopback();
  config.idle_timeout_s = 1;
  const Running running(config);
  Open open(running.channel());
  ASSERT_TRUE(open.accepted());
  // Text comes out as it went in: enough of it fills every buffer on the way back.
  v1::Block text;
  text.mutable_passthrough()->set_text(std::string(60'000, 'M'));
  std::thread writer([&] {
    for (std::uint64_t i = 0; open.send(batch(i, {text}, false)); ++i) {
    }
  });
  EXPECT_TRUE(eventually([&] { return running.server->backend().streams.count() == 0; }, 40));
  writer.join();
  EXPECT_FALSE(open.end().ok());
}

TEST(Server, MessageBeyondTheLimitIsRefused) {
  const Running running(loopback());
  v1::CompensateProgramRequest request = text_request(0, std::string(2'000'000, '\n'), true);
  const StreamAnswer answer =
      call_program(running.channel(), {setup_request(v1::ProgramSetup()), request});
  EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_NE(answer.status.error_message().find("1048576"), std::string::npos);
}

TEST(Server, BatchBeyondTheLimitIsRefused) {
  Config config = loopback();
  config.max_blocks_per_batch = 3;
  const Running running(config);
  const StreamAnswer answer = call_path(
      running.channel(),
      {setup_request(v1::PathSetup()), batch(0, std::vector<v1::Block>(4, line_to(1, 1)), true)});
  EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(answer.reason(), "BATCH_TOO_LARGE");
  EXPECT_TRUE(answer.status.error_message().ends_with(": 4 of 3")) << answer.status.error_message();
}

TEST(Server, LongSelectionsOfAllStreamsShareTheMemory) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted under ThreadSanitizer";
  Config config = loopback();
  config.max_session_memory_mib = 1;
  const Running running(config);
  v1::PathSetup setup;
  setup.set_tool_radius(0.1);
  // G238 needs the whole contour before its first point is known.
  setup.set_selection_mode(v1::SELECTION_MODE_INSIDE_CORNER);
  std::vector<v1::CompensatePathRequest> requests{setup_request(setup)};
  std::uint64_t next = 0;
  for (int i = 0; i < 20; ++i) {
    std::vector<v1::Block> blocks;
    if (i == 0) blocks.push_back(command(v1::COMPENSATION_SIDE_LEFT));
    for (int k = 0; k < 400; ++k)
      blocks.push_back(line_to(static_cast<double>(next) + k, k % 2 == 0 ? 0.0 : 0.3));
    requests.push_back(batch(next, blocks, false));
    next += blocks.size();
  }
  const StreamAnswer answer = call_path(running.channel(), requests);
  EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED) << answer.status.error_message();
  EXPECT_EQ(answer.reason(), "MEMORY_LIMIT");
  EXPECT_TRUE(eventually([&] { return running.server->backend().memory.used_bytes() == 0; }));
}

TEST(Server, HealthAnswersWhileManyStreamsCompute) {
  const Running running(loopback());
  const auto channel = running.channel();
  std::atomic<bool> stop = false;
  std::vector<std::thread> clients;
  for (int i = 0; i < 8; ++i)
    clients.emplace_back([&] {
      while (!stop) EXPECT_TRUE(run_program(channel, {}, g239_program).status.ok());
    });
  for (int i = 0; i < 50; ++i) EXPECT_EQ(health_of(channel, ""), serving);
  stop = true;
  for (std::thread& client : clients) client.join();
}

// A turn that ends when this test says so.
class Blocking final : public WorkerPool::Job {
 public:
  void turn() noexcept override { gate_.get_future().wait(); }
  void open() { gate_.set_value(); }

 private:
  std::promise<void> gate_;
};

TEST(Server, HealthSaysThatTheWorkersGiveNoTurns) {
  Config config = loopback();
  config.worker_threads = 1;
  config.stall_timeout_s = 1;
  config.admin_listen = "127.0.0.1:0";
  const Running running(config);
  const std::string admin = "127.0.0.1:" + std::to_string(running.server->admin_port());
  const auto channel = running.channel();
  using grpc::health::v1::HealthCheckResponse;
  const auto says = [&](HealthCheckResponse::ServingStatus status, const std::string& readiness) {
    return eventually([&] {
      running.server->look_after();
      return health_of(channel, "") == status &&
             health_of(channel, "trc.v1.TrcService") == status &&
             testing_support::http_get(admin, "/readyz") == readiness;
    });
  };
  EXPECT_TRUE(says(HealthCheckResponse::SERVING, "ready\n"));
  Blocking blocking;
  running.server->backend().pool.submit(blocking);
  EXPECT_TRUE(says(HealthCheckResponse::NOT_SERVING, "stalled: streams wait for a worker\n"));
  // Later the service manager is not told that the server is alive, either.
  EXPECT_TRUE(eventually([&] { return !running.server->is_well(); }));
  EXPECT_NE(testing_support::http_get(admin, "/metrics").find("trc_pool_longest_wait_seconds "),
            std::string::npos);
  blocking.open();
  EXPECT_TRUE(says(HealthCheckResponse::SERVING, "ready\n"));
  EXPECT_TRUE(running.server->is_well());
}

TEST(Server, AdminPortTellsMetricsAndReadiness) {
  Config config = loopback();
  config.admin_listen = "127.0.0.1:0";
  config.max_streams = 77;
  config.max_session_memory_mib = 3;
  const Running running(config);
  EXPECT_GT(running.server->admin_port(), 0);
  EXPECT_TRUE(run_program(running.channel(), {}, g239_program).status.ok());
  ASSERT_TRUE(eventually([&] { return running.server->backend().streams.count() == 0; }));
  const std::string metrics = running.server->backend().telemetry.metrics.exposition();
  for (const char* line : {"grpc_server_started_total{grpc_method=\"CompensateProgram\"",
                           "grpc_server_handled_total{grpc_code=\"OK\"", "trc_streams_active",
                           "trc_build_info{", "trc_pool_queue_depth", "trc_batch_seconds_count",
                           "trc_streams_limit 77\n", "trc_session_memory_limit_bytes 3145728\n"})
    EXPECT_NE(metrics.find(line), std::string::npos) << line << "\n" << metrics;
}

}  // namespace
}  // namespace trc::server
