#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/session/session.h"
#include "proto/wire/block.h"
#include "server/rpc/meter.h"
#include "server/rpc/responses.h"
#include "server/rpc/stream_context.h"

namespace trc::server {

// A path on its way through the core: batches of blocks in, answers out. CompensatePath and
// PreviewPath differ in their messages only.
class PathRun {
 public:
  // The settings must be free of faults.
  PathRun(const StreamContext& stream, const wire::PathSettings& settings);

  // Takes one batch, which must be the next one; nothing more after a final one.
  void feed(const v1::BlockBatch& batch);
  void feed(const v1::BlockColumns& columns);
  // Ends the path, unless it has ended or failed.
  void finish();

  template <class Response, class FinishSlice>
  Turn answer(Response& response, FinishSlice finish_slice) {
    return responses_.next(layout_, response, finish_slice, [&] {
      wire::to_proto(meter_.summary(session_), *response.mutable_summary());
    });
  }

  // The place behind the last batch, once all its answers are out; empty when the path does not go
  // on from there.
  [[nodiscard]] std::string resume_token(const ResumeTokens::Digest& setup) const;
  // Goes on there. The ending when the token is refused.
  [[nodiscard]] std::optional<Ending> resume(std::string_view token,
                                             const ResumeTokens::Digest& setup);

  // Whether little is to be done for so many blocks more, and for what is there.
  [[nodiscard]] bool is_soon_done(std::uint64_t blocks) const;
  [[nodiscard]] std::uint64_t blocks_taken() const { return reader_.next_block(); }
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  // The time of a selection counts from what came out of it last.
  [[nodiscard]] SessionSetup watched(SessionSetup setup);
  template <class Batch>
  void feed_batch(const Batch& batch, const char* field, std::int64_t blocks);
  template <class Batch>
  void read(const Batch& batch);
  bool give(const wire::PathInput& input);
  // Compensates what was given.
  bool advance();

  StreamContext stream_;
  wire::Layout layout_;
  PathSession session_;
  wire::BlockReader reader_;
  Responses responses_;
  Meter meter_;
  std::size_t items_ = 0;  // given, of the batch
  bool verifies_ = false;
  bool finished_ = false;
};

}  // namespace trc::server
