#pragma once

#include <grpcpp/server_context.h>

#include <optional>
#include <string>
#include <vector>

#include "server/rpc/status.h"
#include "server/telemetry/trace.h"

namespace trc::server {

// The trace named in the caller's metadata; its id goes back to the caller as `trace-id`.
[[nodiscard]] Trace trace_of(grpc::CallbackServerContext& context);

// Metadata of calls of this process: the client of HTTP that the call is made for.
inline constexpr const char* client_of_http = "trc-client-of-http";

// And the address of that client, as in "192.0.2.7:40000".
inline constexpr const char* address_of_http = "trc-address-of-http";

// The address of the caller as the log names it, also for HTTP: that of a client behind one of the
// `proxies` comes first.
[[nodiscard]] std::string origin_of(const grpc::CallbackServerContext& context,
                                    const std::vector<std::string>& proxies);

// The peer whose limits and share the call counts to: the name in the client's certificate, else
// the address, also for HTTP and for clients behind one of the `proxies`.
[[nodiscard]] std::string peer_of(const grpc::CallbackServerContext& context,
                                  const std::vector<std::string>& proxies);

// The refusal of a caller whose certificate has none of the names; no names allow all. A caller
// without certificate came through a socket file or from this process: with TLS and names given,
// certificates are mandatory.
[[nodiscard]] std::optional<Ending> refuse_caller(const grpc::CallbackServerContext& context,
                                                  const std::vector<std::string>& allowed);

}  // namespace trc::server
