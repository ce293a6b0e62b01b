#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/config.h"

namespace trc::server {

// How the server proves who it is at TCP ports: plain text, TLS, or TLS with client certificates.
// The PEM files are watched: a new certificate holds for new connections without a restart.
std::shared_ptr<grpc::ServerCredentials> tcp_credentials(const Config& config);

}  // namespace trc::server
