#pragma once

#include <memory>

#include "server/rpc/reactors_by_kind.h"

namespace trc::server {

// The reactor of one stream, started; it lives until gRPC is done with it.
template <class Work, class Reactor, class... Messages>
Reactor* start_stream(Backend& backend, grpc::CallbackServerContext& context, Method method,
                      Messages&... messages) {
  const auto reactor = std::make_shared<Reactor>(backend, context, method, messages...);
  reactor->start(std::make_unique<Work>(reactor->stream_context()));
  return reactor.get();
}

}  // namespace trc::server
