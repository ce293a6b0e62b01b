#pragma once

#include <openssl/types.h>

#include <string>

namespace trc::server {

// Why nobody could connect to a server with this certificate chain and this key, both PEM; empty
// where somebody could. gRPC takes a pair that its library refuses later, and then answers no
// handshake: this does one within the process, with the protocols, ciphers and curve of gRPC, and
// a client that looks at what the certificates are for.
[[nodiscard]] std::string fault_of_handshake(const std::string& chain, const std::string& key);

// Why no client gets in for whom this certificate vouches, as the end of a sentence that begins
// with it; empty where one may.
[[nodiscard]] std::string fault_of_authority(X509& authority);

}  // namespace trc::server
