#include "server/service.h"

#include <memory>

#include "server/resources/peers.h"
#include "server/rpc/caller.h"
#include "server/rpc/compensate_path.h"
#include "server/rpc/compensate_program.h"
#include "server/rpc/compensate_program_once.h"
#include "server/rpc/get_server_info.h"
#include "server/rpc/preview_path.h"
#include "server/rpc/start_stream.h"
#include "server/rpc/stream_refusals.h"
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

namespace {

// One answer of GetServerInfo. A client may leave its some fifty kilobytes unread, so the answer
// takes one of the client's places until it is gone.
class ServerInfoReactor final : public grpc::ServerUnaryReactor {
 public:
  ServerInfoReactor(Backend& backend, grpc::CallbackServerContext& context,
                    grpc::ByteBuffer& response)
      : peer_(backend.peers.of(peer_of(context, backend.config.trusted_proxies))), place_(*peer_) {
    CallRecord record(backend.telemetry, Method::get_server_info,
                      origin_of(context, backend.config.trusted_proxies), trace_of(context));
    const Ending ending = answer(backend, context, response);
    record.ended(ending);
    Finish(ending.status);
  }

 private:
  void OnDone() override { delete this; }

  Ending answer(const Backend& backend, const grpc::CallbackServerContext& context,
                grpc::ByteBuffer& response) const {
    const Config& config = backend.config;
    if (auto refused = refuse_caller(context, config.tls_allowed_clients)) return *refused;
    if (auto refused = refuse_crowd(backend, *peer_)) return *refused;
    v1::GetServerInfoResponse info;
    describe(config, info);
    bool own = false;
    static_cast<void>(
        grpc::SerializationTraits<v1::GetServerInfoResponse>::Serialize(info, &response, &own));
    return {};
  }

  const std::shared_ptr<Peer> peer_;
  const Peer::Place place_;
};

}  // namespace

grpc::ServerUnaryReactor* TrcService::GetServerInfo(grpc::CallbackServerContext* context,
                                                    const grpc::ByteBuffer* /*request*/,
                                                    grpc::ByteBuffer* response) {
  return new ServerInfoReactor(backend_, *context, *response);
}

}  // namespace trc::server
