#pragma once

#include <grpcpp/server_builder.h>

#include <memory>

#include "server/backend.h"

namespace trc::server {

// gRPC reflection, v1 and v1alpha: lets clients describe the services without a file. Its streams
// are streams like all others, with their limits, and take no thread while they are silent. gRPC's
// own one has a thread for each, without an end to them.
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
