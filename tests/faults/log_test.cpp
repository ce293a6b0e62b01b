// The log of the built server, where nobody reads it, where it cannot be written, and where there
// is too much of it.

#include <fcntl.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <memory>
#include <regex>
#include <sstream>
#include <string>

#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using std::chrono::seconds;
using testing_support::Folder;
using testing_support::Process;
using testing_support::ServerProcess;

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

TEST(Log, ThatNobodyReadsHoldsUpNothing) {
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

// On standard error, which nobody reads, they would hold up whoever writes them.
TEST(Log, HasTheMessagesOfLibraries) {
  const ServerProcess server;
  const auto stub = v1::TrcService::NewStub(channel_to(server.address()));
  v1::CompensateProgramOnceRequest request;
  request.set_text("\xFF\xFE");
  grpc::ClientContext context;
  v1::CompensateProgramOnceResponse response;
  EXPECT_FALSE(stub->CompensateProgramOnce(&context, request, &response).ok());
  EXPECT_TRUE(eventually([&] {
    return server.log().find("\"event\":\"protobuf\"") != std::string::npos;
  })) << server.log();
  EXPECT_EQ(server.errors(), "");
}

TEST(Log, ThatNobodyReadsDoesNotHoldUpTheEnd) {
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
TEST(Log, ThatCannotBeWrittenIsCountedAndHoldsUpNothing) {
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

  // With room again lines are whole, and begin after the one that was torn.
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
TEST(Log, IntoAPipeThatDoesNotWaitLosesNothing) {
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

TEST(Log, OneKindOfLineDoesNotFloodTheLog) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--max-log-lines-per-s", "5"});
  const auto channel = channel_to(server.address());
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(ask_info(channel).ok());
  EXPECT_GT(metric(server.admin(), "trc_log_lines_dropped_total{cause=\"rate\"}"), 50);
  EXPECT_TRUE(
      eventually([&] { return server.log().find("\"log_lines_dropped\"") != std::string::npos; }));
}

}  // namespace
}  // namespace trc::faults
