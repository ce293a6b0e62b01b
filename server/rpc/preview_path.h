#pragma once

#include <optional>

#include "server/rpc/path_run.h"
#include "server/rpc/stream_work.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// PreviewPath: setup and whole path in one request.
class PreviewPath final : public StreamWork<v1::PreviewPathRequest, v1::PreviewPathResponse> {
 public:
  explicit PreviewPath(const StreamContext& stream) : stream_(stream) {}

  Turn take(const v1::PreviewPathRequest& request, v1::PreviewPathResponse& response) override;
  Turn proceed(v1::PreviewPathResponse& response) override;
  Turn ended(v1::PreviewPathResponse& response) override;

 private:
  StreamContext stream_;
  std::optional<PathRun> run_;
};

}  // namespace trc::server
