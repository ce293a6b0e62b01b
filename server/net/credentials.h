#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/net/certificates.h"

namespace trc::server {

// Credentials of one listening address: plain text without certificates, else TLS with the
// certificate in use at the moment of a handshake, and with client certificates where authorities
// are named. Addresses must not share them: each keeps track of new certificates by itself.
std::shared_ptr<grpc::ServerCredentials> credentials_of(
    const std::shared_ptr<const Certificates>& certificates);

}  // namespace trc::server
