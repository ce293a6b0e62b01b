#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/server.h>

#include <memory>
#include <string>
#include <vector>

#include "server/backend.h"
#include "server/service.h"
#include "server/telemetry/admin.h"

namespace trc::server {

// A running server: service, health, reflection and the admin port of one configuration.
class Server {
 public:
  struct Start {
    std::unique_ptr<Server> server;  // null when it cannot serve
    std::string fault;               // then the reason, one line
  };
  // Opens every address of the configuration, or none. The configuration must be free of faults.
  static Start start(const Config& config);
  // Serves `in_process_channel` alone and opens no address.
  static std::unique_ptr<Server> start_in_process(const Config& config);

  // Ends what is still open at once.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // The ports in the order of `Config::listen`; 0 for a Unix socket.
  [[nodiscard]] const std::vector<int>& ports() const { return ports_; }
  [[nodiscard]] int admin_port() const { return admin_ ? admin_->port() : 0; }
  [[nodiscard]] std::shared_ptr<grpc::Channel> in_process_channel();

  // Takes no new streams, lets the open ones finish within the drain timeout, then ends. Health
  // says NOT_SERVING from the first moment. Returns how many streams had to be cut off.
  std::size_t drain();

  [[nodiscard]] Backend& backend() { return backend_; }

 private:
  Server(const Config& config, std::string resume_key);
  // Empty when the server runs.
  std::string open(bool with_addresses);
  void stop_grpc();

  Backend backend_;
  TrcService service_{backend_};
  std::unique_ptr<grpc::Server> grpc_;
  std::unique_ptr<Admin> admin_;
  std::vector<int> ports_;
};

}  // namespace trc::server
