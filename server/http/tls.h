#pragma once

#include <boost/asio/ssl/context.hpp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/net/certificates.h"

namespace trc::server::http {

// The TLS of new connections: always uses the current certificate.
class Tls {
 public:
  explicit Tls(std::shared_ptr<const Certificates> certificates)
      : certificates_(std::move(certificates)) {}

  // Null when the certificate in use cannot be used.
  [[nodiscard]] std::shared_ptr<boost::asio::ssl::context> context();

 private:
  std::shared_ptr<const Certificates> certificates_;
  std::mutex mutex_;
  std::shared_ptr<boost::asio::ssl::context> context_;
  std::uint64_t version_ = 0;
};

// Whether the client's certificate has one of the names, common or alternative; no names allow all.
[[nodiscard]] bool is_allowed(SSL* connection, const std::vector<std::string>& names);

}  // namespace trc::server::http
