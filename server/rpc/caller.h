#pragma once

#include <grpcpp/server_context.h>

#include <optional>
#include <string>
#include <vector>

#include "server/rpc/status.h"
#include "server/telemetry/trace.h"

namespace trc::server {

// The trace the caller's metadata name; its id goes back to the caller as `trace-id`.
[[nodiscard]] Trace trace_of(grpc::CallbackServerContext& context);

// Metadata of a call of this process' own: for which client of HTTP it is made.
inline constexpr const char* client_of_http = "trc-client-of-http";

// Whose limits and share the call counts against: the name in the client's certificate, else where
// it comes from, also of what comes over HTTP.
[[nodiscard]] std::string peer_of(const grpc::CallbackServerContext& context);

// The refusal of a caller whose certificate has none of the names; no names allow all. Who has
// shown no certificate came through a socket file or from this process: where TLS is spoken and
// names are given, certificates are demanded.
[[nodiscard]] std::optional<Ending> refuse_caller(const grpc::CallbackServerContext& context,
                                                  const std::vector<std::string>& allowed);

}  // namespace trc::server
