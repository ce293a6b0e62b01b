// The built server under clients and surroundings that mean it harm.

#include <fcntl.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <memory>
#include <regex>
#include <sstream>
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

using server::Answer;
using server::eventually;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::content_of;
using testing_support::Folder;
using testing_support::memory_tells;
using testing_support::Process;
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

// A server whose log goes into a pipe that is read only when this test wants to.
class UnreadServer {
 public:
  explicit UnreadServer(const std::string& flags, const std::string& launcher = "")
      : pipe_(made_pipe()),
        process_({"/bin/sh", "-c",
                  "exec " + launcher + testing_support::trcd_program() +
                      " --listen 127.0.0.1:0 --admin-listen 127.0.0.1:0 " + flags + " >" +
                      folder_.path("log")}) {
    eventually([&] {
      read_log();
      return !port("ports").empty();
    });
  }
  ~UnreadServer() { close(pipe_); }
  UnreadServer(const UnreadServer&) = delete;
  UnreadServer& operator=(const UnreadServer&) = delete;

  [[nodiscard]] std::string address() const { return port("ports"); }
  [[nodiscard]] std::string admin() const { return port("admin_port"); }
  [[nodiscard]] Process& process() { return process_; }
  // What has been read so far.
  [[nodiscard]] const std::string& log() const { return log_; }
  void read_log() {
    std::array<char, 4096> part{};
    for (ssize_t size = 0; (size = read(pipe_, part.data(), part.size())) > 0;)
      log_.append(part.data(), static_cast<std::size_t>(size));
  }

 private:
  [[nodiscard]] int made_pipe() const {
    mkfifo(folder_.path("log").c_str(), 0600);
    return open(folder_.path("log").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  }
  [[nodiscard]] std::string port(const std::string& field) const {
    std::smatch found;
    return std::regex_search(log_, found, std::regex("\"" + field + "\":\"?(\\d+)"))
               ? "127.0.0.1:" + found[1].str()
               : "";
  }

  Folder folder_;
  int pipe_;
  Process process_;
  std::string log_;
};

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

grpc::Status ask_info(const std::shared_ptr<grpc::Channel>& channel) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(10));
  v1::GetServerInfoResponse info;
  return v1::TrcService::NewStub(channel)->GetServerInfo(&context, {}, &info);
}

TEST(Hostile, LogThatNobodyReadsHoldsUpNothing) {
  UnreadServer server("--max-log-lines-per-s 1000000");
  ASSERT_FALSE(server.address().empty());
  const auto channel = channel_to(server.address());
  for (int i = 0; i < 2500; ++i) ASSERT_TRUE(ask_info(channel).ok()) << i;
  const auto dropped = [&] {
    return metric(server.admin(), "trc_log_lines_dropped_total{cause=\"unread\"}");
  };
  EXPECT_GT(dropped(), 0);
  EXPECT_GT(metric(server.admin(), "trc_log_blocked_seconds"), 0);
  EXPECT_EQ(testing_support::http_get(server.admin(), "/readyz"), "ready\n");

  // Who reads again gets whole lines, and is told of those that are missing.
  EXPECT_TRUE(eventually([&] {
    server.read_log();
    return server.log().find("\"log_lines_dropped\",\"unread\":") != std::string::npos;
  }));
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = server.log().find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    EXPECT_EQ(server.log()[begin], '{');
    EXPECT_EQ(server.log()[end - 1], '}');
  }
  EXPECT_TRUE(serves(server.address()));
}

TEST(Hostile, LogThatNobodyReadsDoesNotHoldUpTheEnd) {
  UnreadServer server("--max-log-lines-per-s 1000000");
  ASSERT_FALSE(server.address().empty());
  const auto channel = channel_to(server.address());
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(ask_info(channel).ok()) << i;
  const auto begin = std::chrono::steady_clock::now();
  server.process().signal(SIGTERM);
  EXPECT_EQ(server.process().wait(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(8));
}

// As where the disk is full: the file of the log may not grow any more.
TEST(Hostile, LogThatCannotBeWrittenIsCountedAndHoldsUpNothing) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  ASSERT_FALSE(server.address().empty());
  const auto channel = channel_to(server.address());
  const auto room = [&](rlim_t bytes) {
    const rlimit limit{.rlim_cur = bytes, .rlim_max = RLIM_INFINITY};
    ASSERT_EQ(prlimit(server.id(), RLIMIT_FSIZE, &limit, nullptr), 0);
  };
  // The last line that finds room finds it in part only.
  room(server.log().size() + 100);
  constexpr int calls = 20;
  for (int i = 0; i < calls; ++i) ASSERT_TRUE(ask_info(channel).ok()) << i;
  const auto failed = [&] {
    return metric(server.admin(), "trc_log_lines_dropped_total{cause=\"failed\"}");
  };
  EXPECT_TRUE(eventually([&] { return failed() >= calls; })) << failed();
  EXPECT_EQ(testing_support::http_get(server.admin(), "/readyz"), "ready\n");

  // With room again lines are whole, and begin behind the one that was torn.
  room(RLIM_INFINITY);
  EXPECT_TRUE(
      eventually([&] { return server.log().find("\"log_lines_dropped\"") != std::string::npos; }));
  ASSERT_TRUE(ask_info(channel).ok());
  EXPECT_TRUE(eventually([&] { return server.log().ends_with("}\n"); }));
  int torn = 0;
  std::istringstream lines(server.log());
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.find("{\"ts\""), 0U) << line;
    EXPECT_EQ(line.rfind("{\"ts\""), 0U) << line;
    torn += line.ends_with('}') ? 0 : 1;
  }
  EXPECT_EQ(torn, 1) << server.log();
  EXPECT_NE(server.log().find("\"failed\":"), std::string::npos);
}

// Who has started the server may have set the pipe so that it says that there is no room.
TEST(Hostile, LogIntoAPipeThatDoesNotWaitLosesNothing) {
  UnreadServer server("--max-log-lines-per-s 1000000",
                      "/usr/bin/python3 -c 'import os, sys; os.set_blocking(1, False); "
                      "os.execv(sys.argv[1], sys.argv[1:])' ");
  ASSERT_FALSE(server.address().empty());
  const auto channel = channel_to(server.address());
  constexpr int calls = 400;
  for (int i = 0; i < calls; ++i) ASSERT_TRUE(ask_info(channel).ok()) << i;
  EXPECT_TRUE(eventually([&] {
    server.read_log();
    return count_of(server.log(), "\"GetServerInfo\"") == calls;
  }));
}

TEST(Hostile, OneKindOfLineDoesNotFloodTheLog) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--max-log-lines-per-s", "5"});
  const auto channel = channel_to(server.address());
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(ask_info(channel).ok());
  EXPECT_GT(metric(server.admin(), "trc_log_lines_dropped_total{cause=\"rate\"}"), 50);
  EXPECT_TRUE(
      eventually([&] { return server.log().find("\"log_lines_dropped\"") != std::string::npos; }));
}

// Many times: what a stream does, with the number of the stream.
template <class Frames>
std::string flood(int count, std::uint32_t& stream, const Frames& frames) {
  std::string bytes;
  for (int i = 0; i < count; ++i, stream += 2) bytes += frames(stream);
  return bytes;
}

// Sends until the server closes the connection, at most so long. How long somebody else had to wait
// meanwhile is measured.
struct FloodResult {
  bool closed = false;
  double longest_wait_s = 0;
  double resident_mib = 0;  // at most
};
template <class Frames>
FloodResult flood_until_closed(const ServerProcess& server, const std::string& head,
                               const Frames& frames) {
  FloodResult result;
  std::atomic<bool> done = false;
  std::thread other([&] {
    const auto channel = channel_to(server.address());
    while (!done) {
      const auto begin = std::chrono::steady_clock::now();
      const auto answer = server::run_program(channel, {}, server::g239_program);
      EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      result.longest_wait_s = std::max(result.longest_wait_s, took.count());
      result.resident_mib = std::max(result.resident_mib, server.resident_mib());
    }
  });
  const RawConnection connection(server.address(), "127.0.0.2");
  std::uint32_t stream = 1;
  const auto end = std::chrono::steady_clock::now() + seconds(20);
  bool sends = connection.send_bytes(http2::greeting() + head);
  while (sends && std::chrono::steady_clock::now() < end)
    sends = connection.is_open() && connection.send_bytes(flood(200, stream, frames));
  result.closed = !sends;
  done = true;
  other.join();
  return result;
}

double closed_for(const ServerProcess& server, const std::string& reason) {
  return metric(server.admin(), "trc_connections_closed_total{reason=\"" + reason + "\"}");
}

constexpr double longest_stall_s = 4 * testing_support::times_slower;
constexpr double flood_memory_mib = 384;
constexpr double given_back_mib = 128;

// CVE-2023-44487.
TEST(Hostile, StreamsThatAreResetAtOnceEndTheirConnection) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  for (const std::string path :
       {"/trc.v1.TrcService/CompensatePath", "/trc.v1.TrcService/GetServerInfo", "/none"}) {
    SCOPED_TRACE(path);
    const FloodResult result = flood_until_closed(server, "", [&](std::uint32_t stream) {
      return http2::headers(stream, path) + http2::reset(stream);
    });
    EXPECT_TRUE(result.closed);
    EXPECT_LT(result.longest_wait_s, longest_stall_s);
    EXPECT_TRUE(!memory_tells || result.resident_mib < flood_memory_mib) << result.resident_mib;
  }
  EXPECT_EQ(closed_for(server, "early_cancels") + closed_for(server, "calls") +
                closed_for(server, "overhead"),
            3);
  // Once what was begun has been cleared away, its memory is given back.
  EXPECT_TRUE(!memory_tells ||
              eventually([&] { return server.resident_mib() < given_back_mib; }, 60))
      << server.resident_mib();
  EXPECT_NE(server.log().find("\"connection_closed\",\"peer\":\"ipv4:127.0.0.2:"),
            std::string::npos);
}

// DATA frames without a byte on one stream: no flow control holds them back.
TEST(Hostile, FramesThatCarryNothingHoldNobodyUp) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const FloodResult result =
      flood_until_closed(server, http2::headers(1, "/trc.v1.TrcService/CompensatePath"),
                         [](std::uint32_t) { return http2::empty_data(1); });
  EXPECT_TRUE(result.closed) << "or not read any more";
  EXPECT_LT(result.longest_wait_s, longest_stall_s);
  EXPECT_TRUE(!memory_tells || result.resident_mib < flood_memory_mib) << result.resident_mib;
}

// Others find a descriptor however many connections one address opens.
TEST(Hostile, OneAddressHasSoManyConnectionsAndNoMore) {
  constexpr int most = 5;
  const ServerProcess server(
      {"--admin-listen", "127.0.0.1:0", "--max-connections-per-peer", std::to_string(most)});
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
  // And streams of which some are given up.
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
  for (int i = 0; i < 280; ++i, at += text.size())
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

TEST(Hostile, FileThatIsNoSocketIsNotDeleted) {
  const Folder folder;
  const std::string file = folder.write("part.nc", "N5 G1 X0\n");
  const auto ended =
      testing_support::run({testing_support::trcd_program(), "--listen", "unix:" + file});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err, "trcd: error: cannot listen on unix:" + file +
                           ": there is a file which is no socket\n");
  EXPECT_EQ(content_of(file), "N5 G1 X0\n");
}

TEST(Hostile, KeyFileThatIsNoneIsSaidInOneLine) {
  const Folder folder;
  ASSERT_EQ(symlink("nowhere", folder.path("dangling").c_str()), 0);
  ASSERT_EQ(mkdir(folder.path("directory").c_str(), 0700), 0);
  for (const std::string& path : {folder.path("dangling"), folder.path("directory"),
                                  folder.write("zeros", std::string(32, '\0'))}) {
    const auto ended = testing_support::run(
        {testing_support::trcd_program(), "--listen", "127.0.0.1:0", "--resume-key-file", path});
    EXPECT_EQ(ended.code, 2) << path;
    EXPECT_TRUE(ended.err.starts_with("trcd: error: resume-key-file: '" + path + "' "))
        << ended.err;
    EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
  }
}

// Reading a pipe would wait for a writer for ever, and a device never comes to an end.
TEST(Hostile, SettingThatNamesNoPlainFileIsSaidInOneLine) {
  const Folder folder;
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  ASSERT_EQ(mkdir(folder.path("directory").c_str(), 0700), 0);
  const std::string file = folder.write("any.pem", "");
  const std::vector<std::vector<std::string>> settings{
      {"--config"},
      {"--resume-key-file"},
      {"--tls-key-file", file, "--tls-cert-file"},
      {"--tls-cert-file", file, "--tls-key-file"},
      {"--tls-cert-file", file, "--tls-key-file", file, "--tls-client-ca-file"}};
  for (const std::vector<std::string>& setting : settings) {
    for (const std::string& path : {folder.path("pipe"), folder.path("directory"),
                                    std::string("/dev/zero"), folder.path("none")}) {
      if (setting.front() == "--resume-key-file" && path == folder.path("none")) continue;
      std::vector<std::string> command{"/usr/bin/timeout", "10", testing_support::trcd_program(),
                                       "--listen", "127.0.0.1:0"};
      command.insert(command.end(), setting.begin(), setting.end());
      command.push_back(path);
      const auto ended = testing_support::run(command);
      EXPECT_EQ(ended.code, 2) << setting.back() << " " << path;
      EXPECT_NE(ended.err.find("'" + path + "'"), std::string::npos) << ended.err;
      EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
    }
  }
  const auto named =
      testing_support::run({"/usr/bin/env", "TRCD_CONFIG=" + folder.path("pipe"),
                            "/usr/bin/timeout", "10", testing_support::trcd_program()});
  EXPECT_EQ(named.code, 2) << named.err;
}

}  // namespace
}  // namespace trc::faults
