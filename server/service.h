#pragma once

#include "server/backend.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::server {

// Registers the RPCs; each lives in a file of its own under rpc/.
//
// All of them take bytes instead of messages: see StreamReactor.
class TrcService final : public v1::TrcService::WithRawCallbackMethod_CompensatePath<
                             v1::TrcService::WithRawCallbackMethod_CompensateProgram<
                                 v1::TrcService::WithRawCallbackMethod_CompensateProgramOnce<
                                     v1::TrcService::WithRawCallbackMethod_PreviewPath<
                                         v1::TrcService::WithRawCallbackMethod_SurveyRadii<
                                             v1::TrcService::WithRawCallbackMethod_GetServerInfo<
                                                 v1::TrcService::Service>>>>>> {
 public:
  explicit TrcService(Backend& backend) : backend_(backend) {}

  using BytesReactor = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

  BytesReactor* CompensatePath(grpc::CallbackServerContext* context) override;
  BytesReactor* CompensateProgram(grpc::CallbackServerContext* context) override;
  grpc::ServerWriteReactor<grpc::ByteBuffer>* PreviewPath(grpc::CallbackServerContext* context,
                                                          const grpc::ByteBuffer* request) override;
  grpc::ServerUnaryReactor* CompensateProgramOnce(grpc::CallbackServerContext* context,
                                                  const grpc::ByteBuffer* request,
                                                  grpc::ByteBuffer* response) override;
  BytesReactor* SurveyRadii(grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const grpc::ByteBuffer* request,
                                          grpc::ByteBuffer* response) override;

 private:
  Backend& backend_;
};

}  // namespace trc::server
