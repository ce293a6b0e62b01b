#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "server/backend.h"
#include "server/rpc/reactors_by_kind.h"
#include "tests/server/calls.h"

namespace trc::server {
namespace {

using Request = v1::CompensatePathRequest;
using Response = v1::CompensatePathResponse;
using Work = StreamWork<Request, Response>;

// The real reactor around a work of the test.
class TestService final
    : public v1::TrcService::WithRawCallbackMethod_CompensatePath<v1::TrcService::Service> {
 public:
  using MakeWork = std::function<std::unique_ptr<Work>(const StreamContext&)>;

  explicit TestService(MakeWork make_work) : make_work_(std::move(make_work)) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~TestService() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* CompensatePath(
      grpc::CallbackServerContext* context) override {
    const auto reactor = std::make_shared<BidiReactor<Request, Response>>(backend, *context,
                                                                          Method::compensate_path);
    reactor->start(make_work_(reactor->stream_context()));
    return reactor.get();
  }
  [[nodiscard]] std::shared_ptr<grpc::Channel> channel() { return server_->InProcessChannel({}); }

  Backend backend{[] {
                    Config config;
                    config.log_level = "off";
                    config.worker_threads = 2;
                    config.heartbeat_s = 1;
                    return config;
                  }(),
                  std::string(32, 'k')};

 private:
  MakeWork make_work_;
  std::unique_ptr<grpc::Server> server_;
};

// Fails at a batch, ends well without one.
class FailingWork final : public Work {
 public:
  Turn take(const Request& request, Response& /*response*/) override {
    if (request.has_batch()) throw std::logic_error("broken invariant");
    return {};
  }
  Turn proceed(Response& /*response*/) override { return end({}); }
  Turn ended(Response& /*response*/) override { return end({}); }
};

TEST(StreamReactor, BugEndsItsOwnStreamOnly) {
  TestService service([](const StreamContext&) { return std::make_unique<FailingWork>(); });
  const StreamAnswer failed = call_path(service.channel(), {batch(0, {}, true)});
  EXPECT_EQ(failed.status.error_code(), grpc::INTERNAL);
  EXPECT_EQ(failed.reason(), "INTERNAL");
  EXPECT_EQ(failed.metadata("incident_id").size(), 16U);
  EXPECT_EQ(failed.status.error_message().find("invariant"), std::string::npos);
  EXPECT_TRUE(call_path(service.channel(), {setup_request(v1::PathSetup())}).status.ok());
  EXPECT_TRUE(eventually([&] { return service.backend.streams.count() == 0; }));
}

// Has always something to do, a little in each turn.
class EndlessWork final : public Work {
 public:
  EndlessWork(const StreamContext& stream, std::atomic<int>& turns, bool writes)
      : stream_(stream), turns_(turns), writes_(writes) {}

  Turn take(const Request& /*request*/, Response& response) override { return proceed(response); }
  Turn proceed(Response& response) override {
    ++turns_;
    const auto end = Clock::now() + std::chrono::milliseconds(2);
    while (!stream_.cancelled && Clock::now() < end) std::this_thread::yield();
    response.clear_response();
    return {.write = writes_, .next = Turn::Next::proceed, .ending = {}};
  }
  Turn ended(Response& /*response*/) override { return end({}); }

 private:
  StreamContext stream_;
  std::atomic<int>& turns_;
  bool writes_;
};

TEST(StreamReactor, WorkStopsWhenTheClientHasGone) {
  for (const bool writes : {false, true}) {
    std::atomic<int> turns = 0;
    TestService service([&](const StreamContext& stream) {
      return std::make_unique<EndlessWork>(stream, turns, writes);
    });
    const auto stub = v1::TrcService::NewStub(service.channel());
    grpc::ClientContext context;
    const auto stream = stub->CompensatePath(&context);
    stream->Write(batch(0, {}, true));
    // A client that does not read stops the writes after a few.
    ASSERT_TRUE(eventually([&] { return turns > (writes ? 0 : 5); }));
    context.TryCancel();
    EXPECT_TRUE(eventually([&] { return service.backend.streams.count() == 0; }));
    const int turns_at_end = turns;
    EXPECT_EQ(stream->Finish().error_code(), grpc::CANCELLED);
    EXPECT_EQ(turns, turns_at_end);
  }
}

TEST(StreamReactor, DeadlineEndsTheWorkToo) {
  std::atomic<int> turns = 0;
  TestService service([&](const StreamContext& stream) {
    return std::make_unique<EndlessWork>(stream, turns, false);
  });
  const auto stub = v1::TrcService::NewStub(service.channel());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(200));
  const auto stream = stub->CompensatePath(&context);
  stream->Write(batch(0, {}, true));
  EXPECT_EQ(stream->Finish().error_code(), grpc::DEADLINE_EXCEEDED);
  EXPECT_TRUE(eventually([&] { return service.backend.streams.count() == 0; }));
}

TEST(StreamReactor, BusyStreamsDoNotKeepOthersFromTheirTurn) {
  std::atomic<int> turns = 0;
  std::atomic<int> streams = 0;
  TestService service([&](const StreamContext& stream) -> std::unique_ptr<Work> {
    if (streams++ < 8) return std::make_unique<EndlessWork>(stream, turns, false);
    return std::make_unique<FailingWork>();
  });
  const auto channel = service.channel();
  const auto stub = v1::TrcService::NewStub(channel);
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<Request, Response>>> busy;
  for (int i = 0; i < 8; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    busy.push_back(stub->CompensatePath(contexts.back().get()));
    busy.back()->Write(batch(0, {}, true));
  }
  ASSERT_TRUE(eventually([&] { return turns > 16; }));
  EXPECT_TRUE(call_path(channel, {setup_request(v1::PathSetup())}).status.ok());
  for (const auto& context : contexts) context->TryCancel();
  for (const auto& stream : busy) stream->Finish();
}

// Keeps its worker until it is told.
class WaitingWork final : public Work {
 public:
  WaitingWork(std::atomic<int>& waiting, const std::atomic<bool>& told)
      : waiting_(waiting), told_(told) {}

  Turn take(const Request& /*request*/, Response& /*response*/) override {
    ++waiting_;
    told_.wait(false);
    return end({});
  }
  Turn proceed(Response& /*response*/) override { return end({}); }
  Turn ended(Response& /*response*/) override { return end({}); }

 private:
  std::atomic<int>& waiting_;
  const std::atomic<bool>& told_;
};

// Short with a setup, not with anything else.
class SometimesShortWork final : public Work {
 public:
  explicit SometimesShortWork(std::atomic<int>& taken) : taken_(taken) {}

  Turn take(const Request& request, Response& /*response*/) override {
    ++taken_;
    return request.has_setup() ? Turn{} : end({});
  }
  Turn proceed(Response& /*response*/) override { return end({}); }
  Turn ended(Response& /*response*/) override { return end({}); }
  [[nodiscard]] bool is_short(const Request* request) const override {
    return request != nullptr && request->has_setup();
  }

 private:
  std::atomic<int>& taken_;
};

TEST(StreamReactor, AShortTurnNeedsNoWorker) {
  std::atomic<int> waiting = 0;
  std::atomic<int> taken = 0;
  std::atomic<bool> told = false;
  std::atomic<int> streams = 0;
  TestService service([&](const StreamContext&) -> std::unique_ptr<Work> {
    if (streams++ < 2) return std::make_unique<WaitingWork>(waiting, told);
    return std::make_unique<SometimesShortWork>(taken);
  });
  const auto stub = v1::TrcService::NewStub(service.channel());
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<Request, Response>>> open;
  const auto begin = [&](const Request& request) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    open.push_back(stub->CompensatePath(contexts.back().get()));
    open.back()->Write(request);
  };
  for (int i = 0; i < 2; ++i) begin(batch(0, {}, true));
  ASSERT_TRUE(eventually([&] { return waiting == 2; }));

  begin(setup_request(v1::PathSetup()));
  EXPECT_TRUE(eventually([&] { return taken == 1; }));
  open.back()->Write(batch(0, {}, true));
  EXPECT_TRUE(eventually([&] { return service.backend.pool.queue_depth() == 1; }));
  EXPECT_EQ(taken, 1);

  told = true;
  told.notify_all();
  for (const auto& stream : open) EXPECT_TRUE(stream->Finish().ok());
  EXPECT_EQ(taken, 2);
}

}  // namespace
}  // namespace trc::server
