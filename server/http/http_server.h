#pragma once

#include <grpcpp/channel.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "server/backend.h"
#include "server/http/offer.h"
#include "server/net/certificates.h"
#include "server/net/listener.h"

namespace trc::server::http {

// HTTP/1.1 beside gRPC: JSON, NC text and the page. Connections have threads of their own;
// computing is done by the service of this process, so that for streams of gRPC it is like any
// other stream.
class HttpServer {
 public:
  struct Options {
    std::shared_ptr<grpc::Channel> channel{};            // to the service of this process
    std::shared_ptr<const Certificates> certificates{};  // null: plain text
    bool local = true;                                   // can be reached from this machine only
    std::optional<Offer> offer{};                        // of `trc view`
  };
  // The backend must outlive the server.
  HttpServer(Backend& backend, Options options);
  // Closes what is still open.
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // Takes a connection over. From any thread.
  void take(Descriptor connection);
  // True once no request is in progress; false if that does not happen by the deadline.
  bool wait_until_idle(std::chrono::steady_clock::time_point deadline);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trc::server::http
