#include "server/telemetry/admin.h"

#include <CivetServer.h>
#include <netdb.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "server/net/address.h"
#include "server/net/listener.h"

namespace trc::server {
namespace {

struct Answer {
  int status = 200;
  std::string body;
};

// Connects without sending anything.
void knock_at(const std::string& address, int port) {
  const auto parts = split_host_port(address);
  const bool at_all =
      !parts || parts->host.empty() || parts->host == "0.0.0.0" || parts->host == "::";
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(at_all ? nullptr : parts->host.c_str(), std::to_string(port).c_str(), &hints,
                  &found) != 0)
    return;
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, &freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    const Descriptor caller(socket(one->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (caller.valid()) static_cast<void>(connect(caller.number(), one->ai_addr, one->ai_addrlen));
  }
}

}  // namespace

class Admin::Page : public CivetHandler {
 public:
  explicit Page(std::function<Answer()> answer) : answer_(std::move(answer)) {}

  bool handleGet(CivetServer* /*server*/, mg_connection* connection) override {
    const Answer answer = answer_();
    write_head(answer, connection);
    mg_write(connection, answer.body.data(), answer.body.size());
    return true;
  }
  bool handleHead(CivetServer* /*server*/, mg_connection* connection) override {
    write_head(answer_(), connection);
    return true;
  }

 private:
  static void write_head(const Answer& answer, mg_connection* connection) {
    mg_printf(connection,
              "HTTP/1.1 %d %s\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\n"
              "Content-Length: %zu\r\nConnection: close\r\nX-Content-Type-Options: nosniff\r\n\r\n",
              answer.status, answer.status == 200 ? "OK" : "Service Unavailable",
              answer.body.size());
  }

  std::function<Answer()> answer_;
};

std::unique_ptr<Admin> Admin::open(const std::string& address, Answers answers) {
  try {
    std::unique_ptr<Admin> admin(new Admin(std::make_unique<CivetServer>(
        std::vector<std::string>{"listening_ports", address, "num_threads", "4",
                                 "request_timeout_ms", "1000", "enable_keep_alive", "no"})));
    admin->address_ = address;
    const auto add = [&](const char* path, std::function<Answer()> answer) {
      admin->pages_.push_back(std::make_unique<Page>(std::move(answer)));
      admin->http_->addHandler(path, *admin->pages_.back());
    };
    add("/metrics", [metrics = std::move(answers.metrics)] {
      return Answer{.status = 200, .body = metrics()};
    });
    add("/healthz", [] { return Answer{.status = 200, .body = "ok\n"}; });
    add("/readyz", [unready = std::move(answers.unready)] {
      const std::string why = unready();
      return why.empty() ? Answer{.status = 200, .body = "ready\n"}
                         : Answer{.status = 503, .body = why + "\n"};
    });
    return admin;
  } catch (const CivetException&) {
    return nullptr;
  }
}

Admin::Admin(std::unique_ptr<CivetServer> http) : http_(std::move(http)) {}

// Stops the threads of the HTTP server before the pages they use are destroyed. CivetWeb checks for
// a stop every two seconds, which is too long for the end of a process, and at each connection.
Admin::~Admin() {
  const int port = this->port();
  std::atomic<bool> stopped = false;
  std::thread knocker;
  try {
    knocker = std::thread([&] {
      while (!stopped) {
        knock_at(address_, port);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
  } catch (const std::system_error&) {  // the server stops without knocking, only later
  }
  http_.reset();
  stopped = true;
  if (knocker.joinable()) knocker.join();
}

int Admin::port() const {
  const std::vector<int> ports = http_->getListeningPorts();
  return ports.empty() ? 0 : ports.front();
}

}  // namespace trc::server
