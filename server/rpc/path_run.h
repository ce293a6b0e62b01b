#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/session/path_session.h"
#include "proto/wire/block.h"
#include "server/rpc/stream_run.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// A path on its way through the core: batches of blocks in, answers out. CompensatePath and
// PreviewPath differ in their messages only.
class PathRun : public StreamRun<PathSession> {
 public:
  using Request = v1::CompensatePathRequest;
  using Response = v1::CompensatePathResponse;
  using SetupMessage = v1::PathSetup;
  using Settings = wire::PathSettings;
  static constexpr const char* what_a_request_is = "setup, batch or columns";
  static const v1::PathSetup& path_of(const v1::PathSetup& setup) { return setup; }
  static v1::PathSetup& path_of(v1::PathSetup& setup) { return setup; }
  static const wire::PathSettings& path_of(const Settings& settings) { return settings; }

  // The settings must be free of faults.
  PathRun(const StreamContext& stream, const Settings& settings);

  // Takes one batch, which must be the next one; nothing more after a final one.
  void feed(const Request& request);
  // The whole path in one request.
  void feed(const v1::PreviewPathRequest& request);

  // `finish_slice(last)` adds the token.
  template <class FinishSlice>
  Turn answer(Response& response, FinishSlice finish_slice) {
    return next(
        response,
        [&](const Outbox::Slice& /*slice*/, bool last) {
          if (last && reader_.next_block() > 0)
            response.set_consumed_through_block(reader_.next_block() - 1);
          else
            response.clear_consumed_through_block();
          finish_slice(last);
        },
        [&] { summarize(*response.mutable_summary()); });
  }
  Turn answer(v1::PreviewPathResponse& response) {
    return next(
        response, [](const Outbox::Slice& /*slice*/, bool /*last*/) {},
        [&] { summarize(*response.mutable_summary()); });
  }

  // The state after the last batch, once all its answers are out; empty when the path does not go
  // on from there.
  [[nodiscard]] std::string resume_token(const ResumeTokens::Digest& setup) const;
  // Goes on from a token. Returns the ending when the token is refused.
  [[nodiscard]] std::optional<Ending> resume(std::string_view token,
                                             const ResumeTokens::Digest& setup);
  // Whether the next turn is soon done, as of StreamWork.
  [[nodiscard]] bool is_short(const Request* request) const;

 private:
  template <class Batch>
  void feed_batch(const Batch& batch, const char* field, std::int64_t blocks);
  void feed_batch(const v1::BlockBatch& batch);
  void feed_batch(const v1::BlockColumns& columns);
  template <class Batch>
  void read(const Batch& batch);
  bool give(const wire::PathInput& input);
  // Compensates what was given.
  bool advance() { return goes_on(session_.advance(answers())); }
  // Ends the path, unless it has ended or failed.
  void finish();
  void summarize(v1::PathSummary& message) const;

  wire::BlockReader reader_;
  std::size_t items_ = 0;  // given, of the batch
};

}  // namespace trc::server
