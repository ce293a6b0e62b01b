#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/archive.h"
#include "core/session/program_session.h"
#include "server/rpc/meter.h"
#include "server/rpc/responses.h"
#include "server/rpc/stream_context.h"

namespace trc::server {

// A session in a stream: its answers go to the responses, its computing is metered, and its
// state is the content of tokens. The run of each RPC derives from it and reads the
// requests.
template <class Session>
class StreamRun {
 public:
  using Setup = std::conditional_t<std::is_same_v<Session, ProgramSession>, ProgramSessionSetup,
                                   SessionSetup>;

  StreamRun(const StreamRun&) = delete;
  StreamRun& operator=(const StreamRun&) = delete;

  // The last input has been taken.
  [[nodiscard]] bool finished() const { return finished_; }

 protected:
  // The settings must be free of faults.
  StreamRun(const StreamContext& stream, const wire::PathSettings& settings, Setup setup)
      : stream_(stream),
        session_(watched(std::move(setup))),
        responses_(stream.backend, stream.record),
        meter_(settings.session.compensator.limits),
        layout_(settings.response_layout),
        verifies_(settings.session.verify != Verify::off) {}
  ~StreamRun() = default;

  [[nodiscard]] Answers& answers() { return responses_.outbox().content(); }
  // For the result of each call of the session: an error that has stopped it ends the RPC.
  bool goes_on(bool session_goes_on) {
    if (!session_goes_on) responses_.end_with_error();
    return session_goes_on;
  }
  // Ends the path or the text.
  template <class... End>
  void finish_session(const End&... end) {
    finished_ = true;
    static_cast<void>(goes_on(session_.finish(end..., answers())));
    responses_.finish();
  }
  // To be called after each request.
  void note_progress() {
    if (meter_.note(session_.summary())) stream_.account.progressed();
  }

  // As of Responses::next.
  template <class Response, class FinishSlice, class Summarize>
  Turn next(Response& response, FinishSlice finish_slice, Summarize summarize) {
    return responses_.next(layout_, response, finish_slice, summarize);
  }

  // Whether so many more blocks, and the output that waits for the client, take little work. A
  // verification measures a whole selection at its end.
  [[nodiscard]] bool is_soon_done(std::uint64_t blocks, std::size_t most_waiting_bytes) const {
    return !verifies_ && meter_.holds_few() && blocks <= Meter::few_blocks &&
           !responses_.outbox().holds(most_waiting_bytes + 1);
  }

  // The state after the last request, once all its answers are out: the session and `place`, the
  // further state of the run. Empty when the stream does not go on from there.
  template <class... Place>
  [[nodiscard]] std::string token_of(const ResumeTokens::Digest& setup,
                                     const Place&... place) const {
    if (finished_ || responses_.failed()) return {};
    return stream_.backend.resume_tokens.seal(setup, [&](StateWriter& archive) {
      archive(session_, place..., meter_, responses_.outbox().blocks_taken());
    });
  }
  // Goes on from a token. Returns the ending when the token is refused.
  template <class... Place>
  [[nodiscard]] std::optional<Ending> go_on_from(std::string_view token,
                                                 const ResumeTokens::Digest& setup,
                                                 Place&... place) {
    return stream_.backend.resume_tokens.open(token, setup, [&](StateReader& archive) {
      std::uint64_t blocks_out = 0;
      archive(session_, place..., meter_, blocks_out);
      responses_.outbox().go_on_behind(blocks_out);
    });
  }

  StreamContext stream_;
  Session session_;
  Responses responses_;
  Meter meter_;

 private:
  // The time of a selection counts from its last output.
  [[nodiscard]] Setup watched(Setup setup) {
    SessionSetup* session = nullptr;
    if constexpr (std::is_same_v<Session, ProgramSession>)
      session = &setup.session;
    else
      session = &setup;
    session->compensator.interrupt = [this] {
      if (responses_.outbox().has_grown()) stream_.account.progressed();
      stream_.pass();
    };
    stream_.tell_measuring(*session);
    return setup;
  }

  wire::Layout layout_;
  bool verifies_;
  bool finished_ = false;
};

}  // namespace trc::server
