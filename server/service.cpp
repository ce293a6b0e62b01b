#include "server/service.h"

#include "server/rpc/caller.h"
#include "server/rpc/compensate_path.h"
#include "server/rpc/compensate_program.h"
#include "server/rpc/compensate_program_once.h"
#include "server/rpc/get_server_info.h"
#include "server/rpc/preview_path.h"
#include "server/rpc/start_stream.h"
#include "server/rpc/survey_radii.h"

namespace trc::server {

TrcService::BytesReactor* TrcService::CompensatePath(grpc::CallbackServerContext* context) {
  using Reactor = BidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse>;
  return start_stream<server::CompensatePath, Reactor>(backend_, *context, Method::compensate_path);
}

TrcService::BytesReactor* TrcService::CompensateProgram(grpc::CallbackServerContext* context) {
  using Reactor = BidiReactor<v1::CompensateProgramRequest, v1::CompensateProgramResponse>;
  return start_stream<server::CompensateProgram, Reactor>(backend_, *context,
                                                          Method::compensate_program);
}

grpc::ServerWriteReactor<grpc::ByteBuffer>* TrcService::PreviewPath(
    grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  using Reactor = AnswerReactor<v1::PreviewPathRequest, v1::PreviewPathResponse>;
  return start_stream<server::PreviewPath, Reactor>(backend_, *context, Method::preview_path,
                                                    *request);
}

grpc::ServerUnaryReactor* TrcService::CompensateProgramOnce(grpc::CallbackServerContext* context,
                                                            const grpc::ByteBuffer* request,
                                                            grpc::ByteBuffer* response) {
  using Reactor = UnaryReactor<v1::CompensateProgramOnceRequest, v1::CompensateProgramOnceResponse>;
  return start_stream<server::CompensateProgramOnce, Reactor>(
      backend_, *context, Method::compensate_program_once, *request, *response);
}

TrcService::BytesReactor* TrcService::SurveyRadii(grpc::CallbackServerContext* context) {
  using Reactor = BidiReactor<v1::SurveyRadiiRequest, v1::SurveyRadiiResponse>;
  return start_stream<server::SurveyRadii, Reactor>(backend_, *context, Method::survey_radii);
}

grpc::ServerUnaryReactor* TrcService::GetServerInfo(grpc::CallbackServerContext* context,
                                                    const grpc::ByteBuffer* /*request*/,
                                                    grpc::ByteBuffer* response) {
  CallRecord record(backend_.telemetry, Method::get_server_info, context->peer(),
                    trace_of(*context));
  const Ending ending =
      refuse_caller(*context, backend_.config.tls_allowed_clients).value_or(Ending{});
  if (ending.status.ok()) {
    v1::GetServerInfoResponse answer;
    describe(backend_.config, answer);
    bool own = false;
    static_cast<void>(
        grpc::SerializationTraits<v1::GetServerInfoResponse>::Serialize(answer, response, &own));
  }
  record.ended(ending);
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  reactor->Finish(ending.status);
  return reactor;
}

}  // namespace trc::server
