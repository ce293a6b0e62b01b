#pragma once

#include <grpcpp/generic/async_generic_service.h>

#include <string>

#include "server/backend.h"

namespace trc::server {

// Refuses calls to RPCs that do not exist, and names the one that was asked for and those that
// exist. gRPC itself says UNIMPLEMENTED without a word. Such a call computes nothing, takes no
// thread and counts against the limits of its connection like any other.
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
