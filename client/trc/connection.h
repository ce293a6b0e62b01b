#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "client/trc/failure.h"
#include "trc/v1/trc_service.pb.h"

namespace grpc {
class Channel;
}

namespace trc::client {

// PEM files. Without any the connection is not encrypted.
struct TlsFiles {
  std::string ca{};    // of the server; empty with a certificate: the system's
  std::string cert{};  // of the client, together with `key`
  std::string key{};
};

// A way to one server. Cheap to copy; a connection serves any number of sessions
// and re-establishes itself.
class Connection {
 public:
  // HOST:PORT, [IPV6]:PORT or unix:/path. Fails when a file cannot be read, not
  // when nobody listens: sessions find that out.
  [[nodiscard]] static std::optional<Failure> open(const std::string& address, const TlsFiles& tls,
                                                   std::optional<Connection>& connection);
  // Through a channel that exists, an in-process one above all.
  explicit Connection(std::shared_ptr<grpc::Channel> channel) : channel_(std::move(channel)) {}

  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }

  // Version, limits and tables of the server.
  [[nodiscard]] std::optional<Failure> server_info(std::chrono::milliseconds timeout,
                                                   v1::GetServerInfoResponse& info) const;
  // Whether the server takes new streams.
  [[nodiscard]] std::optional<Failure> health(std::chrono::milliseconds timeout,
                                              bool& serving) const;

 private:
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace trc::client
