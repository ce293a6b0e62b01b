#pragma once

#include <grpcpp/server_builder.h>

#include <memory>

#include "server/backend.h"

namespace trc::server {

// gRPC reflection, v1 and v1alpha: lets clients describe the services without a file. Its streams
// have the limits of all others, and take no thread while they are silent. gRPC's own reflection
// uses a thread for each stream, without a limit.
class Reflection {
 public:
  explicit Reflection(Backend& backend);
  ~Reflection();
  Reflection(const Reflection&) = delete;
  Reflection& operator=(const Reflection&) = delete;

  // Must outlive the server that is built.
  void add_to(grpc::ServerBuilder& builder);

 private:
  struct Services;
  std::unique_ptr<Services> services_;
};

}  // namespace trc::server
