#pragma once

#include "server/backend.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::server {

// Registers the RPCs; each lives in a file of its own under rpc/.
class TrcService final : public v1::TrcService::CallbackService {
 public:
  explicit TrcService(Backend& backend) : backend_(backend) {}

  grpc::ServerBidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse>* CompensatePath(
      grpc::CallbackServerContext* context) override;
  grpc::ServerBidiReactor<v1::CompensateProgramRequest, v1::CompensateProgramResponse>*
  CompensateProgram(grpc::CallbackServerContext* context) override;
  grpc::ServerWriteReactor<v1::PreviewPathResponse>* PreviewPath(
      grpc::CallbackServerContext* context, const v1::PreviewPathRequest* request) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* request,
                                          v1::GetServerInfoResponse* response) override;

 private:
  Backend& backend_;
};

}  // namespace trc::server
