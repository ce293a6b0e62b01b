#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

class CivetServer;

namespace trc::server {

// The HTTP port for machines that watch the server: /metrics for Prometheus, /healthz (the process
// answers) and /readyz (it takes new streams; 503 and the reason when not). Read only.
class Admin {
 public:
  struct Answers {
    std::function<std::string()> metrics;
    // Why no new streams are taken; empty when they are.
    std::function<std::string()> unready;
  };

  // Address: HOST:PORT; port 0 takes a free one. Null when it cannot be opened.
  static std::unique_ptr<Admin> open(const std::string& address, Answers answers);
  ~Admin();

  [[nodiscard]] int port() const;

 private:
  class Page;
  explicit Admin(std::unique_ptr<CivetServer> http);

  std::vector<std::unique_ptr<Page>> pages_;
  std::unique_ptr<CivetServer> http_;
  std::string address_{};
};

}  // namespace trc::server
