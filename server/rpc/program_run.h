#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/job_record.h"
#include "server/rpc/stream_run.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// An NC program on its way through the core: text cut anywhere in, answers out.
class ProgramRun : public StreamRun<ProgramSession> {
 public:
  using Request = v1::CompensateProgramRequest;
  using Response = v1::CompensateProgramResponse;
  using SetupMessage = v1::ProgramSetup;
  using Settings = wire::ProgramSettings;
  static constexpr const char* what_a_request_is = "setup or text";
  static const v1::PathSetup& path_of(const v1::ProgramSetup& setup) { return setup.path(); }
  static v1::PathSetup& path_of(v1::ProgramSetup& setup) { return *setup.mutable_path(); }
  static const wire::PathSettings& path_of(const Settings& settings) { return settings.path; }

  // The settings must be free of faults.
  ProgramRun(const StreamContext& stream, const Settings& settings);

  // Before the first chunk: keeps the record that the setup may ask for.
  void record(const SetupMessage& setup) {
    if (setup.record()) record_.emplace(setup);
  }

  // Takes the next chunk, which must go on where the last one ended; nothing more after a final
  // one.
  void feed(const Request& request);

  // `finish_slice(last)` adds the token.
  template <class FinishSlice>
  Turn answer(Response& response, FinishSlice finish_slice) {
    if (responses_.outbox().empty() && (!input_.empty() || is_executing_)) go_on();
    if (record_ && responses_.is_refused() && responses_.outbox().empty()) {
      response.Clear();
      close_record(response, nullptr);
      return {.write = true, .next = Turn::Next::proceed, .ending = {}};
    }
    return next(
        response,
        [&](const Outbox::Slice& slice, bool last) {
          response.mutable_nc_text()->assign(slice.text);
          bytes_out_ += slice.text.size();
          response.set_consumed_bytes(last ? bytes_in_ : bytes_answered_);
          if (last) bytes_answered_ = bytes_in_;
          if (record_) add_to_record(slice, response);
          finish_slice(last);
        },
        [&] {
          summarize(*response.mutable_summary());
          if (record_) close_record(response, &response.summary());
        });
  }

  // As of PathRun.
  [[nodiscard]] std::string resume_token(const ResumeTokens::Digest& setup) const;
  [[nodiscard]] std::optional<Ending> resume(std::string_view token,
                                             const ResumeTokens::Digest& setup);
  [[nodiscard]] bool is_short(const Request* request) const;

 private:
  void take(const v1::ProgramText& chunk);
  // Takes input until there is much output, or all input is taken.
  void go_on();
  bool execute();
  // Gives the blocks to the tap, if there is one, in place of messages.
  void give_to_tap();
  void summarize(v1::ProgramSummary& message) const;
  void add_to_record(const Outbox::Slice& slice, const Response& response);
  void close_record(Response& response, const v1::ProgramSummary* summary);

  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_answered_ = 0;  // input whose output is all out
  std::uint64_t bytes_out_ = 0;
  std::uint64_t blocks_seen_ = 0;
  std::uint64_t blocks_written_ = 0;
  bool gives_text_;
  std::optional<StreamedRecord> record_{};
  // Of the request that is being taken.
  std::string input_{};
  std::size_t input_taken_ = 0;
  bool input_is_final_ = false;
  bool is_executing_ = false;  // all input is taken, and computes
};

}  // namespace trc::server
