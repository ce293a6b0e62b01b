#include "server/telemetry/admin.h"

#include <CivetServer.h>

#include <utility>

namespace trc::server {
namespace {

struct Answer {
  int status = 200;
  std::string body;
};

}  // namespace

class Admin::Page : public CivetHandler {
 public:
  explicit Page(std::function<Answer()> answer) : answer_(std::move(answer)) {}

  bool handleGet(CivetServer* /*server*/, mg_connection* connection) override {
    const Answer answer = answer_();
    mg_printf(connection,
              "HTTP/1.1 %d %s\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\n"
              "Content-Length: %zu\r\nConnection: close\r\nX-Content-Type-Options: nosniff\r\n\r\n",
              answer.status, answer.status == 200 ? "OK" : "Service Unavailable",
              answer.body.size());
    mg_write(connection, answer.body.data(), answer.body.size());
    return true;
  }

 private:
  std::function<Answer()> answer_;
};

std::unique_ptr<Admin> Admin::open(const std::string& address, Answers answers) {
  try {
    std::unique_ptr<Admin> admin(new Admin(std::make_unique<CivetServer>(
        std::vector<std::string>{"listening_ports", address, "num_threads", "2",
                                 "request_timeout_ms", "5000", "enable_keep_alive", "no"})));
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

// The server stops its threads before the pages they answer from go.
Admin::~Admin() { http_.reset(); }

int Admin::port() const {
  const std::vector<int> ports = http_->getListeningPorts();
  return ports.empty() ? 0 : ports.front();
}

}  // namespace trc::server
