#pragma once

#include <grpcpp/generic/async_generic_service.h>

#include <string>

#include "server/backend.h"

namespace trc::server {

// Answers calls of RPCs that there are not: at once, with the name that was asked for and those
// there are. gRPC itself says UNIMPLEMENTED without a word. Such a call computes nothing, takes no
// thread and counts against what a connection may have like any other.
class UnknownRpc final : public grpc::CallbackGenericService {
 public:
  explicit UnknownRpc(const Backend& backend) : backend_(backend) {}

  grpc::ServerGenericBidiReactor* CreateReactor(
      grpc::GenericCallbackServerContext* context) override;

 private:
  const Backend& backend_;
};

// "trc.v1.TrcService has CompensatePath, …", all of them.
[[nodiscard]] std::string known_rpcs();

}  // namespace trc::server
