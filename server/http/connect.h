#pragma once

#include <google/protobuf/descriptor.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/rpc_exchange.h"

namespace trc::server::http {

class Api;

// The Connect protocol (connectrpc.com) for the RPCs of trc.v1 that are unary or server streams:
// POST /trc.v1.TrcService/METHOD with a message as JSON or as Protobuf, or in an envelope for a
// stream. Streams from the client are for gRPC.
void answer_connect(Api& api, const ExchangePointer& exchange);

// The RPC a path names; null when there is none.
[[nodiscard]] const google::protobuf::MethodDescriptor* rpc_at(const std::string& path);

// The header Connect-Timeout-Ms, which every request may have; false: it is no number of at most
// ten digits.
[[nodiscard]] bool read_timeout(std::string_view header,
                                std::optional<std::chrono::milliseconds>& timeout);

}  // namespace trc::server::http
