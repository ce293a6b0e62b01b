#pragma once

#include <string>

namespace trc::server {

// Why nobody could connect to a server with this certificate chain and this key, both PEM; empty
// where somebody could. gRPC takes a pair that its library refuses later, and then answers no
// handshake: this does one within the process, with the protocols, ciphers and curve of gRPC.
[[nodiscard]] std::string fault_of_handshake(const std::string& chain, const std::string& key);

}  // namespace trc::server
