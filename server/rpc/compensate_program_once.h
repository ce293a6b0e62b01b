#pragma once

#include <cstddef>

#include "server/rpc/compensate_program.h"
#include "server/rpc/stream_work.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// CompensateProgramOnce: setup and text in one request, the whole result in one answer. It is
// CompensateProgram with both ends in this class: the same program gives the same bytes.
class CompensateProgramOnce final
    : public StreamWork<v1::CompensateProgramOnceRequest, v1::CompensateProgramOnceResponse> {
 public:
  explicit CompensateProgramOnce(const StreamContext& stream)
      : program_(stream), most_bytes_(stream.backend.config.max_message_bytes) {}

  Turn take(const v1::CompensateProgramOnceRequest& request,
            v1::CompensateProgramOnceResponse& response) override;
  Turn proceed(v1::CompensateProgramOnceResponse& response) override;
  Turn ended(v1::CompensateProgramOnceResponse& response) override;

 private:
  // Takes all answers to the last request. Ends with the program, or with an answer too large.
  [[nodiscard]] Turn collect(Turn turn, v1::CompensateProgramOnceResponse& response);

  CompensateProgram program_;
  v1::CompensateProgramResponse part_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;  // of the parts so far
};

}  // namespace trc::server
