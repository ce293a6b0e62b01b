#include "server/net/credentials.h"

#include <grpc/grpc.h>
#include <grpc/grpc_security.h>

#include <string>
#include <utility>

namespace trc::server {
namespace {

// The C++ classes of gRPC read certificates once, or watch files and take any content. Only its C
// interface asks at every handshake.
class CurrentCertificate final : public grpc::ServerCredentials {
 public:
  explicit CurrentCertificate(std::shared_ptr<const Certificates> certificates)
      : certificates_(std::move(certificates)) {
    const auto ask = certificates_->current()->client_authorities.empty()
                         ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
                         : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY;
    credentials_ = grpc_ssl_server_credentials_create_with_options(
        grpc_ssl_server_credentials_create_options_using_config_fetcher(ask, &fetch, this));
  }
  ~CurrentCertificate() override { grpc_server_credentials_release(credentials_); }

  void SetAuthMetadataProcessor(
      const std::shared_ptr<grpc::AuthMetadataProcessor>& /*processor*/) override {}

 private:
  int AddPortToServer(const std::string& address, grpc_server* server) override {
    return grpc_server_add_http2_port(server, address.c_str(), credentials_);
  }

  // gRPC calls this with a lock of the listening address held.
  static grpc_ssl_certificate_config_reload_status fetch(
      void* self, grpc_ssl_server_certificate_config** config) {
    auto& credentials = *static_cast<CurrentCertificate*>(self);
    const auto current = credentials.certificates_->current();
    if (current->version == credentials.version_)
      return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
    const grpc_ssl_pem_key_cert_pair pair{.private_key = current->key.c_str(),
                                          .cert_chain = current->chain.c_str()};
    // gRPC needs authorities even if it asks for no client certificate.
    const std::string& authorities =
        current->client_authorities.empty() ? current->chain : current->client_authorities;
    *config = grpc_ssl_server_certificate_config_create(authorities.c_str(), &pair, 1);
    credentials.version_ = current->version;
    return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
  }

  std::shared_ptr<const Certificates> certificates_;
  std::uint64_t version_ = 0;
  grpc_server_credentials* credentials_ = nullptr;
};

}  // namespace

std::shared_ptr<grpc::ServerCredentials> credentials_of(
    const std::shared_ptr<const Certificates>& certificates) {
  if (certificates == nullptr) return grpc::InsecureServerCredentials();
  return std::make_shared<CurrentCertificate>(certificates);
}

}  // namespace trc::server
