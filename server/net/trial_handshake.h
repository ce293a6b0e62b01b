#pragma once

#include <openssl/types.h>

#include <string>

namespace trc::server {

// Why no client could connect to a server with this certificate chain and this key, both PEM; empty
// where one could. gRPC accepts a pair that its library refuses later, and then answers no
// handshake. So this makes a handshake within the process, with the protocols, ciphers and curve of
// gRPC, and a client that checks the purpose of the certificates.
[[nodiscard]] std::string fault_of_handshake(const std::string& chain, const std::string& key);

// Why no client certified by this authority gets in, as the end of a sentence that begins with it;
// empty where one does.
[[nodiscard]] std::string fault_of_authority(X509& authority);

}  // namespace trc::server
