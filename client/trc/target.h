#pragma once

#include <optional>
#include <string>

#include "client/trc/failure.h"

namespace trc::client {

// Where a channel leads and how it spreads its streams.
struct Target {
  std::string uri;             // as gRPC reads it
  std::string service_config;  // JSON; empty: what gRPC does by itself
};

// What one address, or several with commas between, mean to gRPC. `tls`: the servers have to show
// certificates.
[[nodiscard]] std::optional<Failure> target_of(const std::string& address, bool tls,
                                               Target& target);

}  // namespace trc::client
