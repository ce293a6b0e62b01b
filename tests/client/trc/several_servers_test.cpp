// Sessions that have more than one server to go to.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/trc/failure.h"
#include "client/trc/remote_program_session.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/in_process.h"
#include "server/server.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

namespace trc::client::several_servers {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Servers of one key at ports of their own.
class Servers {
 public:
  explicit Servers(std::size_t count, std::uint32_t drain_timeout_s = 30) {
    config_ = server::InProcessServer::quiet();
    config_.drain_timeout_s = drain_timeout_s;
    config_.resume_key_file = folder_.path("key");
    config_.listen = {"127.0.0.1:0"};
    for (std::size_t i = 0; i < count; ++i) {
      servers_.push_back(server::Server::start(config_).server);
      if (i > 0) addresses_ += ",";
      addresses_ += "127.0.0.1:" + std::to_string(servers_.back()->ports().front());
    }
  }

  [[nodiscard]] const std::string& addresses() const { return addresses_; }
  [[nodiscard]] server::Server& operator[](std::size_t i) { return *servers_[i]; }
  [[nodiscard]] std::size_t streams(std::size_t i) {
    return servers_[i]->backend().streams.count();
  }
  void kill(std::size_t i) { servers_[i].reset(); }

  [[nodiscard]] Connection connection(milliseconds patience = milliseconds(20'000)) const {
    ConnectionOptions options;
    options.resume.first_wait = milliseconds(10);
    options.resume.longest_wait = milliseconds(200);
    options.resume.patience = patience;
    std::optional<Connection> connection;
    EXPECT_FALSE(Connection::open(addresses_, {}, connection, options));
    return *connection;
  }

 private:
  testing_support::Folder folder_;
  server::Config config_;
  std::vector<std::unique_ptr<server::Server>> servers_;
  std::string addresses_;
};

bool eventually(const std::function<bool()>& condition) {
  const auto end = steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (steady_clock::now() > end) return false;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return true;
}

std::string meander(int turns) {
  std::string text = "N10 G00 X0 Y-20\nN20 V.G.WZ_AKT.R=1\nN30 G41 G01 X0 Y0 F1000\n";
  for (int turn = 1; turn <= turns; ++turn)
    text += "G01 X" + std::to_string(10 * turn) + " Y" + std::to_string(5 * (turn % 2)) + "\n";
  return text + "G40 G01 X0 Y-50\nM30\n";
}

// One program on its way: `begin` gives a first part, `finish` the rest.
class Passage {
 public:
  explicit Passage(const Connection& connection) : session_(connection, {}) {}

  bool begin() { return session_.feed(std::string_view(text_).substr(0, text_.size() / 2), take_); }
  bool finish() {
    return session_.feed(std::string_view(text_).substr(text_.size() / 2), take_) &&
           session_.finish(take_);
  }
  [[nodiscard]] const std::string& output() const { return output_; }
  [[nodiscard]] const RemoteProgramSession& session() const { return session_; }

 private:
  const std::string text_ = meander(2000);
  std::string output_;
  Answers take_{[this](const Answer& answer) {
    output_ += answer.text;
    return true;
  }};
  RemoteProgramSession session_;
};

std::string expected() {
  const server::InProcessServer server;
  Passage passage((Connection(server.channel())));
  EXPECT_TRUE(passage.begin() && passage.finish());
  return passage.output();
}

// Begins sessions until each server has one.
void spread(Servers& servers, std::size_t count, const Connection& connection,
            std::vector<std::unique_ptr<Passage>>& runs) {
  ASSERT_TRUE(eventually([&] {
    runs.push_back(std::make_unique<Passage>(connection));
    EXPECT_TRUE(runs.back()->begin());
    for (std::size_t i = 0; i < count; ++i)
      if (servers.streams(i) == 0) return false;
    return true;
  }));
}

TEST(SeveralServers, SessionsGoToAllOfThem) {
  Servers servers(3);
  const Connection connection = servers.connection();
  std::vector<std::unique_ptr<Passage>> runs;
  spread(servers, 3, connection, runs);
  for (std::size_t more = 0; more < 30; ++more) {
    runs.push_back(std::make_unique<Passage>(connection));
    ASSERT_TRUE(runs.back()->begin());
  }
  // By turns once all are connected, which takes the first sessions.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(servers.streams(i), 10U);
  const std::string path = expected();
  for (const auto& run : runs) {
    EXPECT_TRUE(run->finish());
    EXPECT_EQ(run->output(), path);
    EXPECT_EQ(run->session().resumed(), 0U);
  }
}

TEST(SeveralServers, ClientsOfOneSessionEachGoToAllOfThem) {
  Servers servers(3);
  std::vector<std::unique_ptr<Passage>> runs;
  for (std::size_t client = 0; client < 60; ++client) {
    runs.push_back(std::make_unique<Passage>(servers.connection()));
    ASSERT_TRUE(runs.back()->begin());
  }
  // By chance a server gets fewer than four of sixty once in two million times.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(servers.streams(i), 4U);
}

TEST(SeveralServers, SessionsOfADeadOneGoOnAtAnother) {
  Servers servers(2);
  const Connection connection = servers.connection();
  std::vector<std::unique_ptr<Passage>> runs;
  spread(servers, 2, connection, runs);
  const std::size_t on_the_second = servers.streams(1);
  servers.kill(0);
  const std::string path = expected();
  std::uint64_t resumed = 0;
  for (const auto& run : runs) {
    EXPECT_TRUE(run->finish());
    EXPECT_EQ(run->output(), path);
    resumed += run->session().resumed();
  }
  EXPECT_EQ(resumed, runs.size() - on_the_second);
  Passage late(connection);
  EXPECT_TRUE(late.begin() && late.finish());
}

TEST(SeveralServers, OneThatStopsGetsNoNewSessionAndFinishesItsOwn) {
  Servers servers(2);
  const Connection connection = servers.connection();
  std::vector<std::unique_ptr<Passage>> runs;
  spread(servers, 2, connection, runs);
  std::size_t cut_off = 1;
  std::thread drainer([&] { cut_off = servers[0].drain(); });
  ASSERT_TRUE(eventually([&] { return servers[0].backend().streams.draining(); }));
  const std::size_t own = servers.streams(0);
  for (std::size_t more = 0; more < 20; ++more) {
    runs.push_back(std::make_unique<Passage>(connection));
    EXPECT_TRUE(runs.back()->begin());
  }
  EXPECT_EQ(servers.streams(0), own);
  const std::string path = expected();
  for (const auto& run : runs) {
    EXPECT_TRUE(run->finish());
    EXPECT_EQ(run->output(), path);
  }
  drainer.join();
  EXPECT_EQ(cut_off, 0U);
}

TEST(SeveralServers, SessionsThatOneCutsOffGoOnAtAnother) {
  Servers servers(2, 1);
  const Connection connection = servers.connection();
  std::vector<std::unique_ptr<Passage>> runs;
  spread(servers, 2, connection, runs);
  const std::size_t cut_off = servers.streams(0);
  EXPECT_EQ(servers[0].drain(), cut_off);
  const std::string path = expected();
  std::uint64_t resumed = 0;
  for (const auto& run : runs) {
    EXPECT_TRUE(run->finish());
    EXPECT_EQ(run->output(), path);
    resumed += run->session().resumed();
  }
  EXPECT_EQ(resumed, cut_off);
}

// A balancer may still send sessions to it: they come again.
TEST(SeveralServers, SessionRefusedByOneThatStopsWaitsForTheNext) {
  Servers servers(1);
  const Connection connection = servers.connection(milliseconds(3'000));
  Passage held(connection);
  ASSERT_TRUE(held.begin());
  std::thread drainer([&] { servers[0].drain(); });
  ASSERT_TRUE(eventually([&] { return servers[0].backend().streams.draining(); }));
  Passage refused(connection);
  std::thread opener([&] { EXPECT_FALSE(refused.begin()); });
  EXPECT_TRUE(held.finish());
  drainer.join();
  servers.kill(0);
  opener.join();
  // Nobody came: what it was told at last, and not at once.
  ASSERT_TRUE(refused.session().failure());
  EXPECT_EQ(refused.session().failure()->status, "UNAVAILABLE");
}

TEST(SeveralServers, NameIsLookedUp) {
  const Servers servers(1);
  const std::string port = servers.addresses().substr(servers.addresses().rfind(':'));
  std::optional<Connection> connection;
  ASSERT_FALSE(Connection::open("dns:///localhost" + port, {}, connection));
  Passage passage(*connection);
  EXPECT_TRUE(passage.begin() && passage.finish());
  EXPECT_EQ(passage.output(), expected());
}

// As HAProxy passes on a refusal before the client has said all: details and a reset.
TEST(SeveralServers, WordOfTheServerCountsMoreThanTheResetAfterIt) {
  google::rpc::ErrorInfo reason;
  reason.set_reason("SERVER_DRAINING");
  google::rpc::Status said;
  said.set_code(grpc::UNAVAILABLE);
  said.set_message("the server is shutting down");
  said.add_details()->PackFrom(reason);
  const auto failure = failure_of(grpc::Status(
      grpc::CANCELLED, "Received RST_STREAM with error code 8", said.SerializeAsString()));
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->status, "UNAVAILABLE");
  EXPECT_EQ(failure->message, "the server is shutting down");
  EXPECT_EQ(failure->reason, "SERVER_DRAINING");
  EXPECT_TRUE(failure->not_taken());
}

TEST(SeveralServers, NobodyThereIsSaidAtOnce) {
  std::optional<Connection> connection;
  ASSERT_FALSE(Connection::open("127.0.0.1:1,127.0.0.1:2", {}, connection));
  const auto begin = steady_clock::now();
  Passage passage(*connection);
  EXPECT_FALSE(passage.begin());
  EXPECT_EQ(passage.session().failure()->status, "UNAVAILABLE");
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(SeveralServers, ListsThatCannotBeFollowedAreRefused) {
  struct Case {
    std::string address;
    TlsFiles tls{};
  };
  const std::string certificate =
      testing_support::source_dir() + "/tests/server/certificates/ca_cert.pem";
  for (const Case& tested : std::array<Case, 6>{
           Case{.address = "127.0.0.1:1,[::1]:2"}, Case{.address = "127.0.0.1:1,box:2"},
           Case{.address = "127.0.0.1:1,,127.0.0.1:2"}, Case{.address = "127.0.0.1:1,127.0.0.1"},
           Case{.address = "unix:/a,unix:/b"},
           Case{.address = "127.0.0.1:1,127.0.0.1:2", .tls = {.ca = certificate}}}) {
    std::optional<Connection> connection;
    const auto failure = Connection::open(tested.address, tested.tls, connection);
    ASSERT_TRUE(failure) << tested.address;
    EXPECT_EQ(failure->reason, "ADDRESS_INVALID") << tested.address;
    EXPECT_FALSE(connection) << tested.address;
  }
}

}  // namespace
}  // namespace trc::client::several_servers
