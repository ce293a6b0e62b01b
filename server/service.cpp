#include "server/service.h"

#include <memory>

#include "server/rpc/caller.h"
#include "server/rpc/compensate_path.h"
#include "server/rpc/compensate_program.h"
#include "server/rpc/get_server_info.h"
#include "server/rpc/preview_path.h"
#include "server/rpc/stream_reactor.h"

namespace trc::server {
namespace {

// The reactor of one stream, started; it lives until gRPC is done with it.
template <class Work, class Reactor, class... Request>
Reactor* start(Backend& backend, grpc::CallbackServerContext& context, Method method,
               const Request&... request) {
  const auto reactor = std::make_shared<Reactor>(backend, context, method, request...);
  reactor->start(std::make_unique<Work>(reactor->stream_context()));
  return reactor.get();
}

}  // namespace

grpc::ServerBidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse>*
TrcService::CompensatePath(grpc::CallbackServerContext* context) {
  using Reactor = BidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse>;
  return start<server::CompensatePath, Reactor>(backend_, *context, Method::compensate_path);
}

grpc::ServerBidiReactor<v1::CompensateProgramRequest, v1::CompensateProgramResponse>*
TrcService::CompensateProgram(grpc::CallbackServerContext* context) {
  using Reactor = BidiReactor<v1::CompensateProgramRequest, v1::CompensateProgramResponse>;
  return start<server::CompensateProgram, Reactor>(backend_, *context, Method::compensate_program);
}

grpc::ServerWriteReactor<v1::PreviewPathResponse>* TrcService::PreviewPath(
    grpc::CallbackServerContext* context, const v1::PreviewPathRequest* request) {
  using Reactor = AnswerReactor<v1::PreviewPathRequest, v1::PreviewPathResponse>;
  return start<server::PreviewPath, Reactor>(backend_, *context, Method::preview_path, *request);
}

grpc::ServerUnaryReactor* TrcService::GetServerInfo(grpc::CallbackServerContext* context,
                                                    const v1::GetServerInfoRequest* /*request*/,
                                                    v1::GetServerInfoResponse* response) {
  CallRecord record(backend_.telemetry, Method::get_server_info, context->peer(),
                    trace_of(*context));
  const Ending ending =
      refuse_caller(*context, backend_.config.tls_allowed_clients).value_or(Ending{});
  if (ending.status.ok()) describe(backend_.config, *response);
  record.ended(ending);
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  reactor->Finish(ending.status);
  return reactor;
}

}  // namespace trc::server
