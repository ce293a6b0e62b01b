#pragma once

#include <optional>

#include "server/rpc/path_run.h"
#include "server/rpc/stream_work.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// CompensatePath: the setup, then batches, the last of them final.
class CompensatePath final
    : public StreamWork<v1::CompensatePathRequest, v1::CompensatePathResponse> {
 public:
  explicit CompensatePath(const StreamContext& stream) : stream_(stream) {}

  Turn take(const v1::CompensatePathRequest& request,
            v1::CompensatePathResponse& response) override;
  Turn proceed(v1::CompensatePathResponse& response) override;
  Turn ended(v1::CompensatePathResponse& response) override;
  [[nodiscard]] bool is_short(const v1::CompensatePathRequest* request) const override;

 private:
  Turn set_up(const v1::PathSetup& message, v1::CompensatePathResponse& response);

  StreamContext stream_;
  std::optional<PathRun> run_;
  bool want_tokens_ = false;
  ResumeTokens::Digest setup_{};  // where tokens are wanted or given
};

}  // namespace trc::server
