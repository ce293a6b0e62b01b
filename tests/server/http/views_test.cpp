// Views that many make, look at, break off and give up at once, until the server ends in the midst
// of it: what is seen of a program is always all of it, and nothing is left behind. Above all for
// the sanitizers.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "proto/wire/json.h"
#include "server/resources/memory_account.h"
#include "server/server.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"
#include "trc/v1/http.pb.h"

namespace trc::server {
namespace {

using std::chrono::milliseconds;
using testing_support::times_slower;

struct Reply {
  int status = 0;
  std::string body{};
};

// One client that asks by HTTP.
class Client {
 public:
  explicit Client(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    wait_at_most(milliseconds(20'000 * times_slower));
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_port = htons(static_cast<in_port_t>(port));
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0;
  }
  ~Client() { close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  [[nodiscard]] bool connected() const { return connected_; }
  void wait_at_most(milliseconds time) const {
    const timeval longest{.tv_sec = time.count() / 1000, .tv_usec = time.count() % 1000 * 1000};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
  }
  bool send_bytes(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  // None: the server has gone, or says nothing for too long.
  [[nodiscard]] std::optional<Reply> reply() {
    while (true) {
      if (const auto whole = whole_reply()) return whole;
      std::array<char, 65'536> part{};
      const ssize_t size = ::recv(socket_, part.data(), part.size(), 0);
      if (size <= 0) return std::nullopt;
      received_.append(part.data(), static_cast<std::size_t>(size));
    }
  }
  [[nodiscard]] std::optional<Reply> ask(std::string_view method, const std::string& path,
                                         std::string_view body = {}) {
    if (!send_bytes(head_of(method, path, body.size())) || !send_bytes(body)) return std::nullopt;
    return reply();
  }
  [[nodiscard]] static std::string head_of(std::string_view method, const std::string& path,
                                           std::size_t bytes) {
    return std::string(method) + " " + path +
           " HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/plain\r\nContent-Length: " +
           std::to_string(bytes) + "\r\n\r\n";
  }

 private:
  [[nodiscard]] std::optional<Reply> whole_reply() {
    const std::size_t end = received_.find("\r\n\r\n");
    if (end == std::string::npos) return std::nullopt;
    constexpr std::string_view version = "HTTP/1.1 ";
    constexpr std::string_view length = "Content-Length: ";
    const auto number_at = [&](std::size_t at) {
      std::size_t number = 0;
      std::from_chars(received_.data() + at, received_.data() + end, number);
      return number;
    };
    const std::size_t field = received_.find(length);
    const std::size_t bytes = field < end ? number_at(field + length.size()) : 0;
    const std::size_t begin = end + 4;
    if (received_.size() < begin + bytes) return std::nullopt;
    Reply reply{.status = static_cast<int>(number_at(version.size())),
                .body = received_.substr(begin, bytes)};
    received_.erase(0, begin + bytes);
    return reply;
  }

  int socket_;
  bool connected_ = false;
  std::string received_;
};

// What is uploaded, and what every view of it has to say.
struct Upload {
  std::string text;
  std::uint64_t path_blocks;
  bool refused = false;
};

constexpr std::string_view selection = "G1 G41 V.G.WZ_AKT.R=0.01 X1 Y1 F800\n";

// Stairs: each corner but the last is a transition.
Upload stairs(int steps, bool refused, std::size_t bytes = 0) {
  std::string text(selection);
  text += "G91\n";
  for (int i = 0; i < steps; ++i) text += "X.1\nY.1\n";
  text += refused ? "G40\nG1 G41 V.G.WZ_AKT.R=5 X10 Y-10\nX1\nX1\nY1\nX-1\nX-1\nG40\nX9 Y9\nM30\n"
                  : "G40\nG1 X10 Y-10\nM30\n";
  while (text.size() < bytes) text += "(nothing to be seen in this line)\n";
  return {.text = std::move(text), .path_blocks = 0, .refused = refused};
}

const std::string& views_path() {
  static const std::string path = "/v1/views";
  return path;
}

std::optional<v1::View> view_in(const Reply& reply) {
  v1::View view;
  const std::string fault = wire::Json().read(reply.body, view);
  if (fault.empty()) return view;
  ADD_FAILURE() << fault << " in " << reply.body.substr(0, 300);
  return std::nullopt;
}

Config loopback_views() {
  Config config;
  config.listen = {"127.0.0.1:0"};
  config.http_listen = "127.0.0.1:0";
  config.log_level = "off";
  config.worker_threads = 2;
  // So that views are given up while somebody looks at them.
  config.http_max_views = 4;
  return config;
}

class Views : public testing::Test {
 protected:
  Views() : server_(Server::start(loopback_views()).server), port_(server_->http_port()) {}

  void expect_blocks(std::vector<Upload>& uploads) const {
    for (Upload& upload : uploads) {
      Client client(port_);
      const auto reply = client.ask("POST", views_path(), upload.text);
      ASSERT_TRUE(reply && reply->status == 201) << (reply ? reply->body : "no answer");
      const auto view = view_in(*reply);
      ASSERT_TRUE(view);
      EXPECT_EQ(view->refused(), upload.refused);
      EXPECT_GT(view->path_blocks(), 0U);
      upload.path_blocks = view->path_blocks();
    }
  }

  std::unique_ptr<Server> server_;
  const int port_;
};

// Somebody who makes one view after the other. Each client has its own random numbers.
class Visitor {
 public:
  Visitor(int port, const std::vector<Upload>& uploads, unsigned seed, std::atomic<int>& seen)
      : port_(port), uploads_(uploads), random_(seed), seen_(seen) {}

  // Until the server has gone.
  void visit() {
    while (true) {
      Client client(port_);
      if (!client.connected()) return;
      const Upload& upload = uploads_[below(static_cast<int>(uploads_.size()))];
      switch (below(4)) {
        case 0:
          break_upload_off(client, upload);
          break;
        case 1:
          leave_before_the_answer(client, upload);
          break;
        default:
          look(client, upload);
      }
    }
  }

 private:
  [[nodiscard]] unsigned below(int end) {
    return static_cast<unsigned>(std::uniform_int_distribution(0, end - 1)(random_));
  }

  void break_upload_off(const Client& client, const Upload& upload) {
    client.send_bytes(Client::head_of("POST", views_path(), upload.text.size()));
    const std::size_t bytes = below(static_cast<int>(upload.text.size()));
    client.send_bytes(std::string_view(upload.text).substr(0, bytes));
  }

  void leave_before_the_answer(Client& client, const Upload& upload) {
    client.send_bytes(Client::head_of("POST", views_path(), upload.text.size()));
    client.send_bytes(upload.text);
    client.wait_at_most(milliseconds(1 + below(100)));
    (void)client.reply();
  }

  void look(Client& client, const Upload& upload) {
    const auto made = client.ask("POST", views_path(), upload.text);
    if (!made) return;
    EXPECT_EQ(made->status, 201) << made->body;
    const auto view = view_in(*made);
    if (!view) return;
    EXPECT_EQ(view->path_blocks(), upload.path_blocks);
    EXPECT_EQ(view->refused(), upload.refused);
    ++seen_;
    const std::string path = views_path() + "/" + view->id();
    for (const char* part : {"/tiles/0/0/0", "", "/output?from=1&count=5", "/tiles/3/2/2",
                             "/lines?from=1&count=5", "/blocks?line=5", "/place?share=0.5"}) {
      const auto reply = client.ask("GET", path + part);
      if (!reply) return;
      // Others may have come, and this one given up for them.
      EXPECT_TRUE(reply->status == 200 || reply->status == 404) << part << "\n" << reply->body;
    }
    if (below(2) == 0) (void)client.ask("DELETE", path);
  }

  const int port_;
  const std::vector<Upload>& uploads_;
  std::mt19937 random_;
  std::atomic<int>& seen_;  // views, by all visitors
};

TEST_F(Views, AreWholeHoweverManyComeAndGoUntilTheServerEnds) {
  // The last ones are measured after their picture.
  constexpr std::size_t large = (1U << 20U) + 1;
  std::vector<Upload> uploads{stairs(300, false), stairs(2000, false), stairs(300, true),
                              stairs(1000, false, large)};
  expect_blocks(uploads);
  if (HasFatalFailure()) return;
  constexpr unsigned visitors = 6;
  constexpr int enough = 30;
  std::atomic<int> seen = 0;
  std::vector<Visitor> all;
  for (unsigned i = 0; i < visitors; ++i) all.emplace_back(port_, uploads, i, seen);
  std::vector<std::thread> threads;
  for (Visitor& visitor : all) threads.emplace_back([&visitor] { visitor.visit(); });
  EXPECT_TRUE(eventually([&] { return seen >= enough; }, 30.0 * times_slower)) << seen;
  server_.reset();
  for (std::thread& thread : threads) thread.join();
}

// Not as an answer that another format would fit.
TEST(ViewsWithoutMemory, AreRefusedForThat) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  Config config = loopback_views();
  config.http_max_memory_mib = 1;
  const auto server = Server::start(config).server;
  Client client(server->http_port());
  const auto reply = client.ask("POST", views_path(), stairs(10'000, false).text);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 503);
  EXPECT_NE(reply->body.find("HTTP_MEMORY_LIMIT"), std::string::npos) << reply->body;
}

// Lines that are unrolled and no motion count as well: 30 MB here.
TEST(ViewsWithoutMemory, SayThatTheCompensatedTextIsTooLong) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  Config config = loopback_views();
  config.http_max_memory_mib = 16;
  const auto server = Server::start(config).server;
  Client client(server->http_port());
  const std::string program =
      "O1\nG21 G90 G17\nG0 X-20 Y-20\nG41 G1 X0 Y0 D1 F1000\nY50\nX50\nY0\nX0\nG40 X-20 Y-20\n"
      "#1=0\nWHILE[#1LT500]DO1\n#1=#1+1\n(" +
      std::string(60'000, 'A') + ")\nEND1\nM30\n";
  const auto made = client.ask("POST", views_path() + "?dialect=fanuc&tools=1:5", program);
  ASSERT_TRUE(made);
  ASSERT_EQ(made->status, 201) << made->body;
  const auto view = view_in(*made);
  ASSERT_TRUE(view);
  const std::string path = views_path() + "/" + view->id();
  std::optional<Reply> output;
  EXPECT_TRUE(eventually(
      [&] {
        output = client.ask("GET", path + "/output?count=1");
        return !output || output->body.find("\"pending\"") == std::string::npos;
      },
      30.0 * times_slower));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->status, 503);
  EXPECT_NE(output->body.find("HTTP_MEMORY_LIMIT"), std::string::npos) << output->body;
  // Everything else of the view is still there.
  const auto tile = client.ask("GET", path + "/tiles/0/0/0");
  ASSERT_TRUE(tile);
  EXPECT_EQ(tile->status, 200);
}

TEST_F(Views, KnowNoBlocksOfALineAfterAllOthers) {
  Client client(port_);
  const auto made = client.ask("POST", views_path(), stairs(10, false).text);
  ASSERT_TRUE(made);
  const auto view = view_in(*made);
  ASSERT_TRUE(view);
  const std::string path = views_path() + "/" + view->id() + "/blocks?line=";
  const auto of_line = client.ask("GET", path + "3");
  ASSERT_TRUE(of_line);
  EXPECT_NE(of_line->body.find("\"start\""), std::string::npos) << of_line->body;
  // 2^32 + 3
  const auto behind = client.ask("GET", path + "4294967299");
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->status, 200);
  EXPECT_EQ(behind->body.find("\"start\""), std::string::npos) << behind->body;
}

}  // namespace
}  // namespace trc::server
