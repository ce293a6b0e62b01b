#pragma once

#include <memory>

#include "server/server.h"

namespace trc::server {

// The service inside the calling process, reached through a channel instead of a port: for programs
// that need no server, and for tests. Logs nothing unless told to.
class InProcessServer {
 public:
  explicit InProcessServer(const Config& config = quiet())
      : server_(Server::start_in_process(config)), channel_(server_->in_process_channel()) {}

  // Valid as long as this object lives.
  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  [[nodiscard]] Server& server() { return *server_; }

  static Config quiet() {
    Config config;
    config.log_level = "off";
    config.max_selection_cpu_s = 0;
    config.max_stream_cpu_s = 0;
    return config;
  }

 private:
  std::unique_ptr<Server> server_;
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace trc::server
