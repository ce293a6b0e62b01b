// A selection that is held as a whole is computed when its end comes, which may take as long as it
// likes: everybody else is served meanwhile, and it ends when nobody waits for it.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "grpc/health/v1/health.grpc.pb.h"
#include "server/server.h"
#include "tests/server/calls.h"

namespace trc::server {
namespace {

// ThreadSanitizer looks at every access to memory.
#if defined(__SANITIZE_THREAD__)
constexpr int slowness = 20;
#else
constexpr int slowness = 1;
#endif

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

// Every block is in the way of every other one, which takes minutes to find out.
std::vector<v1::CompensatePathRequest> endless_work() {
  v1::PathSetup setup;
  setup.set_tool_radius(10);
  setup.set_contour_masking(v1::CONTOUR_MASKING_ON);
  setup.mutable_options()->set_remove_masked_blocks(true);
  setup.mutable_options()->set_ignore_cont_damage(true);
  std::vector<v1::Block> blocks{command(v1::COMPENSATION_SIDE_LEFT)};
  for (int i = 0; i < 3900; ++i) blocks.push_back(line_to(1e-3 * i, i % 2 == 0 ? 0 : 1));
  return {setup_request(setup), batch(0, blocks, true)};
}

// A stream that has sent all it has and waits.
class Waiting {
 public:
  explicit Waiting(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(v1::TrcService::NewStub(channel)) {
    context_.set_deadline(std::chrono::system_clock::now() + seconds(60));
    stream_ = stub_->CompensatePath(&context_);
    for (const auto& request : endless_work()) stream_->Write(request);
  }
  ~Waiting() {
    cancel();
    while (stream_->Read(&response_)) {
    }
    EXPECT_EQ(stream_->Finish().error_code(), grpc::CANCELLED);
  }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

  void cancel() { context_.TryCancel(); }

 private:
  std::unique_ptr<v1::TrcService::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::CompensatePathRequest, v1::CompensatePathResponse>>
      stream_;
  v1::CompensatePathResponse response_;
};

class LongSelection : public ::testing::Test {
 protected:
  static constexpr std::uint32_t places = 2;

  void SetUp() override {
    Config config;
    config.listen = {"127.0.0.1:0"};
    config.log_level = "off";
    config.worker_threads = places;
    server_ = Server::start(config).server;
    ASSERT_NE(server_, nullptr);
    address_ = "127.0.0.1:" + std::to_string(server_->ports().front());
  }

  [[nodiscard]] std::shared_ptr<grpc::Channel> channel() const {
    return grpc::CreateChannel(address_, grpc::InsecureChannelCredentials());
  }
  [[nodiscard]] bool is_idle() const { return server_->backend().streams.count() == 0; }

  // More of them than may compute at once, and all of them do.
  [[nodiscard]] std::vector<std::unique_ptr<Waiting>> occupy() const {
    std::vector<std::unique_ptr<Waiting>> streams;
    for (std::uint32_t i = 0; i < places + 1; ++i)
      streams.push_back(std::make_unique<Waiting>(channel()));
    // One more thread than places: a turn stands still while another goes on.
    EXPECT_TRUE(eventually([&] { return server_->backend().pool.thread_count() > places; }));
    return streams;
  }

 private:
  std::unique_ptr<Server> server_;
  std::string address_;
};

template <class Work>
milliseconds median_time(Work work) {
  std::vector<Clock::duration> times;
  for (int round = 0; round < 15; ++round) {
    const auto begin = Clock::now();
    work();
    times.push_back(Clock::now() - begin);
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return std::chrono::duration_cast<milliseconds>(times[times.size() / 2]);
}

TEST_F(LongSelection, LeavesTurnsToOthers) {
  const auto streams = occupy();
  const auto other = channel();
  const milliseconds served =
      median_time([&] { EXPECT_TRUE(run_program(other, {}, g239_program).status.ok()); });
  EXPECT_LT(served.count(), 500 * slowness);
  RecordProperty("served_ms", static_cast<int>(served.count()));
}

TEST_F(LongSelection, LeavesHealthAlone) {
  const auto streams = occupy();
  const auto health = grpc::health::v1::Health::NewStub(channel());
  const milliseconds answered = median_time([&] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + seconds(20));
    grpc::health::v1::HealthCheckResponse response;
    EXPECT_TRUE(health->Check(&context, {}, &response).ok());
  });
  EXPECT_LT(answered.count(), 50 * slowness);
  RecordProperty("answered_ms", static_cast<int>(answered.count()));
}

TEST_F(LongSelection, EndsWhenItIsCancelled) {
  std::vector<milliseconds> times;
  for (int round = 0; round < 5; ++round) {
    auto streams = occupy();
    const auto begin = Clock::now();
    for (const auto& stream : streams) stream->cancel();
    EXPECT_TRUE(eventually([&] { return is_idle(); }));
    times.push_back(std::chrono::duration_cast<milliseconds>(Clock::now() - begin));
  }
  // What else the machine does takes part in some.
  const milliseconds ended = *std::min_element(times.begin(), times.end());
  EXPECT_LT(ended.count(), 100 * slowness);
  RecordProperty("ended_ms", static_cast<int>(ended.count()));
}

TEST_F(LongSelection, EndsAtItsDeadline) {
  const auto begin = Clock::now();
  const auto stub = v1::TrcService::NewStub(channel());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + milliseconds(300));
  const auto stream = stub->CompensatePath(&context);
  for (const auto& request : endless_work()) stream->Write(request);
  v1::CompensatePathResponse response;
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::DEADLINE_EXCEEDED);
  EXPECT_TRUE(eventually([&] { return is_idle(); }));
  EXPECT_LT(Clock::now() - begin, seconds(2));
}

}  // namespace
}  // namespace trc::server
