#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/session/program_session.h"
#include "server/rpc/meter.h"
#include "server/rpc/responses.h"
#include "server/rpc/stream_context.h"
#include "server/rpc/stream_work.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// CompensateProgram: the setup, then NC text cut anywhere, the last piece of it final.
class CompensateProgram final
    : public StreamWork<v1::CompensateProgramRequest, v1::CompensateProgramResponse> {
 public:
  explicit CompensateProgram(const StreamContext& stream) : stream_(stream) {}

  Turn take(const v1::CompensateProgramRequest& request,
            v1::CompensateProgramResponse& response) override;
  Turn proceed(v1::CompensateProgramResponse& response) override;
  Turn ended(v1::CompensateProgramResponse& response) override;
  [[nodiscard]] bool is_short(const v1::CompensateProgramRequest* request) const override;

 private:
  // One program on its way through the core.
  struct Run {
    Run(const StreamContext& stream, const wire::PathSettings& settings,
        const ProgramSessionSetup& setup);

    // As of PathRun.
    [[nodiscard]] ProgramSessionSetup watched(ProgramSessionSetup setup);

    template <class Archive>
    void serialize(Archive& archive) {
      archive(session, meter, bytes_in, bytes_out, blocks_seen);
    }

    // As of PathRun.
    [[nodiscard]] bool is_soon_done(std::uint64_t lines) const;

    StreamContext stream;
    wire::Layout layout;
    ProgramSession session;
    Responses responses;
    Meter meter;
    std::uint64_t bytes_in = 0;
    std::uint64_t bytes_answered = 0;  // input whose output is all out
    std::uint64_t bytes_out = 0;
    std::uint64_t blocks_seen = 0;
    // Of the request that is being taken.
    std::string input{};
    std::size_t input_taken = 0;
    bool input_is_final = false;
    bool verifies = false;
    bool finished = false;
  };

  Turn set_up(const v1::ProgramSetup& message, v1::CompensateProgramResponse& response);
  void feed(const v1::ProgramText& chunk);
  // Takes input until much has come out, or all of it.
  void go_on();
  bool give(std::string_view text);
  void finish();
  // As of PathRun.
  [[nodiscard]] std::string resume_token();
  [[nodiscard]] std::optional<Ending> resume(std::string_view token);

  StreamContext stream_;
  std::optional<Run> run_;
  bool want_tokens_ = false;
  ResumeTokens::Digest setup_{};  // where tokens are wanted or given
};

}  // namespace trc::server
