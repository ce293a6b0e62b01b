#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/backend.h"
#include "server/http/http_server.h"
#include "server/net/certificates.h"
#include "server/net/listener.h"
#include "server/rpc/reflection.h"
#include "server/service.h"
#include "server/telemetry/admin.h"

namespace trc::server {

// A running server: service, health, reflection and the admin port of one configuration.
class Server {
 public:
  struct Start {
    std::unique_ptr<Server> server;  // null when it cannot serve
    std::string fault;               // then the reason, one line
    bool misconfigured = false;      // the reason is a setting, and no port was opened
  };
  // Opens every address of the configuration, or none. The configuration must be free of faults.
  static Start start(const Config& config);
  // Serves HTTP alone, on `Config::http_listen`, for `trc view`.
  static Start start_http(const Config& config, http::Offer offer);
  // Serves `in_process_channel` alone and opens no address.
  static std::unique_ptr<Server> start_in_process(const Config& config);

  // Ends what is still open at once.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // The ports in the order of `Config::listen`; 0 for a Unix socket.
  [[nodiscard]] const std::vector<int>& ports() const { return ports_; }
  [[nodiscard]] int admin_port() const { return admin_ ? admin_->port() : 0; }
  [[nodiscard]] int health_port() const { return health_port_; }
  [[nodiscard]] int http_port() const { return http_port_; }
  [[nodiscard]] std::shared_ptr<grpc::Channel> in_process_channel();

  // Reads the PEM files again: at once, and in `look_after` when it is time. New connections use
  // valid new files; files that cannot be used are logged, counted and ignored.
  void reload_certificates();
  // To be called about once a second, by the thread that reloads.
  void look_after();
  // Connections are being accepted, and the workers give turns.
  [[nodiscard]] bool is_well() const;

  // Takes no new streams, lets the open ones finish within the drain timeout, then ends. Health
  // says NOT_SERVING from the first moment. Returns how many streams had to be cut off.
  std::size_t drain();

  [[nodiscard]] Backend& backend() { return backend_; }

 private:
  Server(const Config& config, std::string resume_key);
  // Empty when there are none or they can be used.
  std::string read_certificates();
  // Who can call it: any client of its addresses, or only this process.
  enum class Callers : std::uint8_t { of_addresses, in_process };
  // Empty when the server runs.
  std::string open(Callers callers);
  std::string listen(grpc::ServerBuilder& builder, const std::string& address,
                     const std::shared_ptr<const Certificates>& certificates, Acceptor::Use use,
                     int& port);
  std::string listen_for_http(std::optional<http::Offer> offer);
  void set_serving(bool serving);
  std::string exposition();
  // Why it takes no new streams; empty when it does.
  [[nodiscard]] std::string readiness() const;
  void look_after_health();
  void look_after_log();
  void stop_grpc();

  Backend backend_;
  TrcService service_{backend_};
  std::unique_ptr<Reflection> reflection_;  // where it is served
  grpc::CallbackGenericService no_service_;
  std::shared_ptr<Certificates> certificates_;
  std::string refused_certificates_;  // why, the last time
  Clock::time_point next_certificate_look_{};
  std::unique_ptr<grpc::Server> grpc_;
  std::unique_ptr<grpc::Server> health_;
  std::unique_ptr<Admin> admin_;
  std::vector<int> ports_;
  int health_port_ = 0;
  std::unique_ptr<http::HttpServer> http_;
  int http_port_ = 0;
  std::uint64_t refused_connections_ = 0;  // as logged last
  bool stalled_ = false;                   // as health says
  Log::Counts dropped_lines_{};            // as logged last
  std::atomic<bool> started_ = false;
  // Last, so that no connection comes once the others go.
  Acceptor acceptor_{backend_.telemetry.connections, backend_.config.max_connections_per_peer};
};

}  // namespace trc::server
