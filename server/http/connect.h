#pragma once

#include <google/protobuf/descriptor.h>

#include <memory>
#include <string>

#include "server/http/run.h"

namespace trc::server::http {

class Api;

// The Connect protocol (connectrpc.com) for the RPCs of trc.v1 that are unary or server streams:
// POST /trc.v1.TrcService/METHOD with a message as JSON or as Protobuf, or in an envelope for a
// stream. Streams from the client are for gRPC.
void answer_connect(Api& api, const ExchangePointer& exchange);

// The RPC a path names; null when there is none.
[[nodiscard]] const google::protobuf::MethodDescriptor* rpc_at(const std::string& path);

}  // namespace trc::server::http
