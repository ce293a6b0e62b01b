// The built server under clients that mean it harm.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "grpc/health/v1/health.grpc.pb.h"
#include "grpc/reflection/v1alpha/reflection.grpc.pb.h"
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
using testing_support::memory_tells;
using testing_support::ServerProcess;

// gRPC inflates a message before it looks at its size.
TEST(Hostile, WhatIsCompressedIsRefusedBeforeItGrows) {
  constexpr std::size_t inflated = 128U << 20U;
  constexpr double allowance_mib = 16;
  const ServerProcess server({"--health-listen", "127.0.0.1:0"});
  ASSERT_TRUE(serves(server.address()));
  const double before = server.resident_mib();
  for (const auto algorithm : {GRPC_COMPRESS_GZIP, GRPC_COMPRESS_DEFLATE}) {
    {
      grpc::ClientContext context;
      context.set_compression_algorithm(algorithm);
      auto stream =
          v1::TrcService::NewStub(channel_to(server.address()))->CompensateProgram(&context);
      stream->Write(server::text_request(0, std::string(inflated, ' '), true));
      EXPECT_EQ(stream->Finish().error_code(), grpc::UNIMPLEMENTED);
    }
    grpc::ClientContext context;
    context.set_compression_algorithm(algorithm);
    grpc::health::v1::HealthCheckRequest request;
    request.set_service(std::string(inflated, ' '));
    grpc::health::v1::HealthCheckResponse response;
    EXPECT_EQ(grpc::health::v1::Health::NewStub(channel_to(server.health()))
                  ->Check(&context, request, &response)
                  .error_code(),
              grpc::UNIMPLEMENTED);
  }
  EXPECT_LT(server.resident_mib(), before + allowance_mib);
  EXPECT_TRUE(serves(server.address()));
}

TEST(Hostile, HealthTakesNoMoreThanTheNameOfAService) {
  const ServerProcess server({"--health-listen", "127.0.0.1:0"});
  grpc::ClientContext context;
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(std::string(5000, 'x'));
  grpc::health::v1::HealthCheckResponse response;
  EXPECT_EQ(grpc::health::v1::Health::NewStub(channel_to(server.health()))
                ->Check(&context, request, &response)
                .error_code(),
            grpc::RESOURCE_EXHAUSTED);
}

using Reflection = grpc::reflection::v1alpha::ServerReflection;

// A reflection stream that has asked once and says no more.
struct SilentReflection {
  explicit SilentReflection(const std::shared_ptr<grpc::Channel>& channel)
      : stream(Reflection::NewStub(channel)->ServerReflectionInfo(&context)) {
    grpc::reflection::v1alpha::ServerReflectionRequest request;
    request.set_list_services("");
    grpc::reflection::v1alpha::ServerReflectionResponse response;
    answered = stream->Write(request) && stream->Read(&response) &&
               response.list_services_response().service_size() > 0;
  }
  ~SilentReflection() { context.TryCancel(); }
  SilentReflection(const SilentReflection&) = delete;
  SilentReflection& operator=(const SilentReflection&) = delete;

  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<grpc::reflection::v1alpha::ServerReflectionRequest,
                                           grpc::reflection::v1alpha::ServerReflectionResponse>>
      stream;
  bool answered = false;
};

TEST(Hostile, SilentReflectionTakesNoThreadsAndEnds) {
  const ServerProcess server({"--idle-timeout-s", "2", "--max-streams", "200"});
  ASSERT_TRUE(serves(server.address()));
  const int before = server.threads();
  std::vector<std::unique_ptr<SilentReflection>> streams;
  std::shared_ptr<grpc::Channel> channel;
  for (int i = 0; i < 120; ++i) {
    if (i % 50 == 0) channel = channel_to(server.address());
    streams.push_back(std::make_unique<SilentReflection>(channel));
    EXPECT_TRUE(streams.back()->answered);
  }
  EXPECT_LE(server.threads(), before + 4);
  EXPECT_TRUE(serves(server.address()));
  for (const auto& stream : streams) {
    grpc::reflection::v1alpha::ServerReflectionResponse response;
    EXPECT_FALSE(stream->stream->Read(&response));
    EXPECT_EQ(stream->stream->Finish().error_code(), grpc::ABORTED);
  }
}

double closed_for(const ServerProcess& server, const std::string& reason) {
  return metric(server.admin(), "trc_connections_closed_total{reason=\"" + reason + "\"}");
}

// Others find a descriptor however many connections one address opens.
TEST(Hostile, OneAddressHasSoManyConnectionsAndNoMore) {
  constexpr int most = 5;
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--health-listen", "127.0.0.1:0",
                              "--max-connections-per-peer", std::to_string(most)});
  const auto connect = [&](const char* from) {
    auto connection = std::make_unique<RawConnection>(server.address(), from);
    connection->send_bytes(http2::greeting());
    return connection;
  };
  std::vector<std::unique_ptr<RawConnection>> held;
  for (int i = 0; i < most; ++i) held.push_back(connect("127.0.0.2"));
  const auto refused = connect("127.0.0.2");
  EXPECT_TRUE(eventually([&] { return !refused->is_open(); }));
  EXPECT_TRUE(eventually([&] { return closed_for(server, "connections") == 1; }));
  for (const auto& connection : held) EXPECT_TRUE(connection->is_open());
  // A balancer that has all it may have still learns how the server is.
  const RawConnection asking(server.health(), "127.0.0.2");
  std::this_thread::sleep_for(milliseconds(100));
  EXPECT_TRUE(asking.is_open());
  EXPECT_TRUE(connect("127.0.0.3")->is_open());
  EXPECT_TRUE(
      server::run_program(channel_to(server.address()), {}, server::g239_program).status.ok());
  // A place that has become free is given again.
  held.pop_back();
  EXPECT_TRUE(eventually([&] {
    const auto next = connect("127.0.0.2");
    std::this_thread::sleep_for(milliseconds(100));
    return next->is_open();
  }));
}

// Who stands in the door of the probes keeps nobody out, neither there nor at the others.
TEST(Hostile, ConnectionsForHealthGiveWayToNewOnes) {
  const ServerProcess server({"--health-listen", "127.0.0.1:0"}, "127.0.0.1:0", 128);
  std::vector<std::unique_ptr<RawConnection>> held;
  for (int i = 0; i < 60; ++i) {
    held.push_back(
        std::make_unique<RawConnection>(server.health(), i % 2 == 0 ? "127.0.0.2" : "127.0.0.3"));
    held.back()->send_bytes(http2::greeting());
  }
  EXPECT_TRUE(serves(server.address()));
  grpc::ClientContext context;
  context.set_wait_for_ready(true);
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  grpc::health::v1::HealthCheckResponse response;
  EXPECT_TRUE(grpc::health::v1::Health::NewStub(channel_to(server.health()))
                  ->Check(&context, {}, &response)
                  .ok());
  EXPECT_TRUE(eventually([&] { return !held.front()->is_open(); }));
}

// An answer that nobody reads takes a place, as a stream does.
TEST(Hostile, AnswersThatAreNotReadTakeThePlacesOfTheirClient) {
  const ServerProcess server({"--max-streams-per-peer", "10"});
  constexpr std::string_view no_window("\0\x04\0\0\0\0", 6);
  const RawConnection connection(server.address(), "127.0.0.2");
  std::string calls = http2::greeting(no_window);
  for (std::uint32_t stream = 1; stream < 121; stream += 2)
    calls += http2::headers(stream, "/trc.v1.TrcService/GetServerInfo") +
             http2::frame(http2::data, 1, stream, std::string_view("\0\0\0\0\0", 5));
  EXPECT_TRUE(connection.send_bytes(calls));
  EXPECT_TRUE(eventually([&] { return server.log().find("STREAM_LIMIT") != std::string::npos; }));
  EXPECT_TRUE(serves(server.address()));
}

TEST(Hostile, ConnectionsThatCarryMuchAreLeftAlone) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const auto channel = channel_to(server.address());
  // Comments: bytes that cost next to nothing to read.
  std::string text;
  while (text.size() < 900'000) text += "N5 (" + std::string(20'000, 'c') + ")\n";
  std::vector<v1::CompensateProgramRequest> requests{server::setup_request(v1::ProgramSetup())};
  std::uint64_t at = 0;
  for (int i = 0; i < 100; ++i, at += text.size())
    requests.push_back(server::text_request(at, text, false));
  requests.push_back(server::text_request(at, "G0 X1\nM30\n", true));
  EXPECT_TRUE(server::call_program(channel, requests).status.ok());
  // Short streams, a third of which the client gives up.
  for (int i = 0; i < 900; ++i) {
    if (i % 3 > 0) {
      EXPECT_TRUE(server::run_program(channel, {}, server::g239_program).status.ok());
      continue;
    }
    grpc::ClientContext context;
    auto stream = v1::TrcService::NewStub(channel)->CompensatePath(&context);
    stream->Write(server::setup_request(v1::PathSetup()));
    context.TryCancel();
    stream->Finish();
  }
  for (const char* reason : {"early_cancels", "overhead", "calls"})
    EXPECT_EQ(closed_for(server, reason), 0) << reason;
}

// Programs of many streams that come faster than they are computed wait in front of the server, not
// in its memory, and are no flood.
TEST(Hostile, ManyLargeProgramsOnOneConnectionAreLeftAlone) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const auto channel = channel_to(server.address());
  constexpr std::size_t message_bytes = 50'000;
  std::string text;
  for (int i = 0; text.size() < message_bytes; ++i)
    text += "G1 X" + std::to_string(i) + ".125 Y" + std::to_string(i % 7) + ".25\n";
  std::vector<v1::CompensateProgramRequest> requests{server::setup_request(v1::ProgramSetup())};
  std::uint64_t at = 0;
  for (int i = 0; i < 80; ++i, at += text.size())
    requests.push_back(server::text_request(at, text, false));
  requests.push_back(server::text_request(at, "M30\n", true));
  std::vector<std::future<bool>> streams;
  for (int i = 0; i < 32; ++i)
    streams.push_back(std::async(
        std::launch::async, [&] { return server::call_program(channel, requests).status.ok(); }));
  int done = 0;
  for (auto& stream : streams) done += stream.get() ? 1 : 0;
  EXPECT_EQ(done, 32);
  EXPECT_EQ(closed_for(server, "overhead"), 0);
}

// What a client has sent ahead when its program is refused is no flood either: it did not know.
TEST(Hostile, ManyRefusedProgramsOnOneConnectionAreLeftAlone) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const auto channel = channel_to(server.address());
  std::vector<std::string> texts(1);
  const auto add = [&](const std::string& line) {
    constexpr std::size_t message_bytes = 64U << 10U;
    if (texts.back().size() + line.size() > message_bytes) texts.emplace_back();
    texts.back() += line;
  };
  const auto motion = [](int i) {
    return "G1 X" + std::to_string(i) + ".125 Y" + std::to_string(i % 7) + ".25\n";
  };
  add("F500\n");
  for (int i = 0; i < 20'000; ++i) add(motion(i));
  add("G999\n");
  for (int i = 0; i < 60'000; ++i) add(motion(i));
  std::vector<v1::CompensateProgramRequest> requests{server::setup_request(v1::ProgramSetup())};
  std::uint64_t at = 0;
  for (const std::string& text : texts) {
    requests.push_back(server::text_request(at, text, &text == &texts.back()));
    at += text.size();
  }
  std::vector<std::future<int>> clients;
  for (int client = 0; client < 8; ++client)
    clients.push_back(std::async(std::launch::async, [&] {
      int refused = 0;
      for (int i = 0; i < 25; ++i)
        refused += server::call_program(channel, requests).status.error_code() ==
                   grpc::StatusCode::INVALID_ARGUMENT;
      return refused;
    }));
  int refused = 0;
  for (auto& client : clients) refused += client.get();
  EXPECT_EQ(refused, 200);
  for (const char* reason : {"overhead", "unfinished"})
    EXPECT_EQ(closed_for(server, reason), 0) << reason;
}

}  // namespace
}  // namespace trc::faults
