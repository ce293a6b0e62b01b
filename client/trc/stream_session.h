#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/trc/connection.h"
#include "client/trc/failure.h"
#include "client/trc/message_size.h"
#include "client/trc/resume_clock.h"
#include "client/trc/stream.h"
#include "core/session/answers.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::client {

// Where a setup says the tool stands.
[[nodiscard]] inline Position start_of(const v1::PathSetup& setup) {
  const v1::Position& start = setup.start_position();
  return {start.x(), start.y(), start.z()};
}
[[nodiscard]] inline Position start_of(const v1::ProgramSetup& setup) {
  return start_of(setup.path());
}

// What both kinds of session share: the window of unanswered requests, reading responses, how a
// stream ends, and how the session goes on when one was lost:
//
//     requests   ──► kept since the last token ──► stream ──► responses ──► answers
//     stream lost ──► wait ──► new stream: setup with the token ──► the kept requests again,
//                              of their answers those left out that the caller has got already
//
// `Summary` is the native summary.
template <class Request, class Response, class Summary>
class StreamSession {
 public:
  using Reactor = grpc::ClientBidiReactor<Request, Response>;
  // Binds a reactor to the RPC.
  using Start = std::function<void(grpc::ClientContext*, Reactor*)>;
  // Input after the last request.
  static constexpr std::uint64_t end_of_input = std::numeric_limits<std::uint64_t>::max();

  template <class Setup>
  StreamSession(const Setup& setup, Start start, const Connection& connection)
      : start_(std::move(start)),
        connection_(connection),
        policy_(connection.resume_policy()),
        clock_(policy_),
        reader_(start_of(setup)),
        reader_at_token_(reader_) {
    *setup_.mutable_setup() = setup;
    path_setup(setup_).set_want_resume_tokens(policy_.patience > policy_.patience.zero());
  }

  // The request to fill before `send`; keeps its memory from one to the next.
  [[nodiscard]] Request& outgoing() { return outgoing_; }

  // Sends the setup, unless that is done, and does not wait until the server has taken it: the
  // first piece of input follows at once.
  bool open(Answers& out) {
    if (std::exchange(opened_, true)) return !failure_;
    reached_ = connection_.reach();
    return launch(out) || recover(out);
  }

  // Sends `outgoing`. `input_end`: the input position after it; `end_of_input` for the last one.
  bool send(std::uint64_t input_end, Answers& out) {
    if (failure_ || finished_) return false;
    keep(input_end);
    return transmit(outgoing_, input_end, out) || recover(out);
  }

  // Hands out the rest and reads the status.
  bool finish(Answers& out) {
    while (!failure_ && !finished_) {
      if (close(out)) finished_ = true;
      if (!finished_ && !recover(out)) break;
    }
    return !failure_;
  }

  [[nodiscard]] const v1::StreamAccepted& limits() const { return limits_; }
  [[nodiscard]] const MessageSize& message_size() const { return message_size_; }
  [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
  [[nodiscard]] const std::optional<Summary>& summary() const { return summary_; }
  // Of CompensateProgram, where the setup asks for it.
  [[nodiscard]] const std::string& record() const { return record_; }
  // How often the session has gone on with a new stream.
  [[nodiscard]] std::uint64_t resumed() const { return resumed_; }
  // Is told now and then how many blocks of the path have been measured, of how many.
  void tell_measuring(std::function<void(std::uint64_t, std::uint64_t)> measuring) {
    measuring_ = std::move(measuring);
  }

 private:
  // What the caller has got since the token.
  struct Handed {
    std::size_t blocks = 0;
    std::size_t bytes = 0;
    std::size_t diagnostics = 0;

    bool operator==(const Handed&) const = default;
  };
  struct Kept {
    std::uint64_t input_end = 0;
    std::size_t bytes = 0;
    Request request{};
  };

  static v1::PathSetup& path_setup(v1::CompensatePathRequest& request) {
    return *request.mutable_setup();
  }
  static v1::PathSetup& path_setup(v1::CompensateProgramRequest& request) {
    return *request.mutable_setup()->mutable_path();
  }

  auto taker(Answers& out) {
    return [this, &out](const Response& response) { return take(response, out); };
  }

  bool launch(Answers& out) {
    stream_.emplace(start_);
    accepted_ = false;
    unanswered_.clear();
    return stream_->send(setup_, taker(out));
  }

  bool begin(Answers& out) {
    if (!launch(out)) return false;
    const auto take = taker(out);
    while (!accepted_)
      if (!stream_->receive(take)) return false;
    return true;
  }

  bool transmit(const Request& request, std::uint64_t input_end, Answers& out) {
    const auto take = taker(out);
    if (input_end != end_of_input) unanswered_.push_back(input_end);
    if (!stream_->send(request, take)) return false;
    while (unanswered_.size() >= window_)
      if (!stream_->receive(take)) return false;
    return true;
  }

  void keep(std::uint64_t input_end) {
    if (policy_.patience <= policy_.patience.zero()) return;
    const std::size_t bytes = outgoing_.ByteSizeLong();
    kept_bytes_ += bytes;
    if (kept_bytes_ > policy_.most_kept_bytes) {
      kept_.clear();
      kept_bytes_ = 0;
      lost_through_ = input_end;
      return;
    }
    kept_.push_back({.input_end = input_end, .bytes = bytes, .request = outgoing_});
  }

  // The stream has ended before its time. Goes on with a new one, or says why not: always false
  // then.
  bool recover(Answers& out) {
    if (finished_) return false;
    for (;;) {
      if ((!failure_ || stopped_) && close(out)) {
        finished_ = true;
        return false;
      }
      if (std::exchange(progressed_, false)) clock_.restart();
      if (!may_resume()) return fail(*failure_);
      if (policy_.waiting) policy_.waiting(*failure_);
      if (!clock_.wait(failure_->retry_after_seconds)) return fail(*failure_);
      failure_.reset();
      reader_ = reader_at_token_;
      to_skip_ = handed_;
      path_setup(setup_).set_resume_token(token_);
      const ResumeClock::Attempt attempt(clock_);
      if (begin(out) && send_kept(out)) {
        ++resumed_;
        return true;
      }
    }
  }

  bool send_kept(Answers& out) {
    // A token that arrives meanwhile drops requests from the front: the next one to send is found
    // by its place.
    std::uint64_t sent_through = 0;
    for (bool sent = false; !kept_.empty();) {
      const auto next = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
        return !sent || kept.input_end > sent_through;
      });
      if (next == kept_.end()) break;
      sent_through = next->input_end;
      sent = true;
      const Request request = next->request;
      if (!transmit(request, sent_through, out)) return false;
    }
    return true;
  }

  // A server that was never there is not waited for; one that has no place now is, as long as it
  // says. And while all input since the token is at hand.
  [[nodiscard]] bool may_resume() const {
    if (policy_.patience <= policy_.patience.zero() || stopped_) return false;
    if (!ever_accepted_) return failure_->asks_to_wait() || (reached_ && failure_->not_taken());
    if (token_position_ < lost_through_) return false;
    return failure_->stream_lost() || failure_->asks_to_wait();
  }

  bool fail(Failure why) {
    failure_ = std::move(why);
    finished_ = true;
    summary_.reset();
    return false;
  }

  // Reads the stream to its end. True when it has ended well.
  bool close(Answers& out) {
    if (stopped_) stream_->cancel();
    const grpc::Status status = stream_->close(taker(out));
    if (!failure_) failure_ = failure_of(status);
    if (!failure_ && !summary_) failure_ = missing_summary();
    if (failure_) summary_.reset();
    return !failure_;
  }

  bool take(const Response& response, Answers& out) {
    if (response.has_heartbeat() && measuring_ && response.heartbeat().has_blocks_to_measure())
      measuring_(response.heartbeat().measured_blocks(), response.heartbeat().blocks_to_measure());
    if (response.has_heartbeat() || stopped_) return true;
    if (response.has_accepted()) {
      accepted_ = ever_accepted_ = true;
      limits_ = response.accepted();
      message_size_.take(limits_);
      window_ = std::max<std::size_t>(limits_.max_batches_in_flight(), 1);
      return true;
    }
    const std::uint64_t consumed = consumed_through(response);
    while (!unanswered_.empty() && unanswered_.front() <= consumed) unanswered_.pop_front();

    std::vector<CompensatedBlock>& blocks = out.blocks();
    std::string& text = out.text();
    std::vector<Diagnostic> diagnostics;
    const Handed before{.blocks = blocks.size(), .bytes = text.size()};
    wire::FieldFaults faults;
    if (response.has_batch()) reader_.read(response.batch(), blocks, faults);
    if (response.has_columns()) reader_.read(response.columns(), blocks, faults);
    if (response.has_summary()) summary_ = wire::from_proto(response.summary());
    if constexpr (requires { response.record(); })
      if (!response.record().empty()) record_ = response.record();
    if (!faults.empty()) {
      blocks.resize(before.blocks);
      return stop(invalid_response(faults));
    }
    text += text_of(response);
    for (const v1::Diagnostic& diagnostic : response.diagnostics())
      diagnostics.push_back(wire::from_proto(diagnostic));
    const Handed fresh{.blocks = leave_out(blocks, before.blocks, to_skip_.blocks),
                       .bytes = leave_out(text, before.bytes, to_skip_.bytes),
                       .diagnostics = leave_out(diagnostics, 0, to_skip_.diagnostics)};
    handed_.blocks += fresh.blocks;
    handed_.bytes += fresh.bytes;
    handed_.diagnostics += fresh.diagnostics;
    out.tell(std::move(diagnostics));
    if (response.has_summary() && to_skip_ != Handed{}) return stop(resumed_path_differs());
    note_token(response.resume_token(), consumed);
    if (fresh == Handed{}) return true;
    progressed_ = true;
    return out.hand_on() || stop({.status = "CANCELLED",
                                  .message = "the caller wanted no more",
                                  .reason = "CALLER_STOPPED"});
  }

  bool stop(Failure why) {
    failure_ = std::move(why);
    stopped_ = true;
    return false;
  }

  // Of what was appended after `before` as much as is to be skipped. Returns how much stays.
  template <class Sequence>
  static std::size_t leave_out(Sequence& answers, std::size_t before, std::size_t& to_skip) {
    const std::size_t count = std::min(answers.size() - before, to_skip);
    const auto first = answers.begin() + static_cast<std::ptrdiff_t>(before);
    answers.erase(first, first + static_cast<std::ptrdiff_t>(count));
    to_skip -= count;
    return answers.size() - before;
  }

  // All answers to the input before `position` are out: only what follows can be needed again. Of
  // that the caller has something already where the stream before had no token there.
  void note_token(const std::string& token, std::uint64_t position) {
    if (token.empty()) return;
    progressed_ = true;
    token_ = token;
    token_position_ = position;
    reader_at_token_ = reader_;
    handed_ = to_skip_;
    while (!kept_.empty() && kept_.front().input_end <= position) {
      kept_bytes_ -= kept_.front().bytes;
      kept_.pop_front();
    }
  }

  // The position after the last input that was answered.
  static std::uint64_t consumed_through(const v1::CompensatePathResponse& response) {
    return response.has_consumed_through_block() ? response.consumed_through_block() + 1 : 0;
  }
  static std::uint64_t consumed_through(const v1::CompensateProgramResponse& response) {
    return response.consumed_bytes();
  }
  static std::string_view text_of(const v1::CompensatePathResponse& /*response*/) { return {}; }
  static std::string_view text_of(const v1::CompensateProgramResponse& response) {
    return response.nc_text();
  }

  Start start_;
  Connection connection_;
  ResumePolicy policy_;
  ResumeClock clock_;
  Request setup_;
  Request outgoing_;
  std::optional<Stream<Request, Response>> stream_;

  wire::CompensatedReader reader_;
  v1::StreamAccepted limits_;
  MessageSize message_size_;
  std::deque<std::uint64_t> unanswered_;  // input positions after each request
  std::size_t window_ = 1;                // until the server says more
  bool opened_ = false;
  bool reached_ = false;  // somebody was there at the beginning
  bool accepted_ = false;
  bool ever_accepted_ = false;
  bool stopped_ = false;  // by the caller, or by a response that no server sends
  bool finished_ = false;
  bool progressed_ = true;  // since the stream was lost last
  std::uint64_t resumed_ = 0;
  std::function<void(std::uint64_t, std::uint64_t)> measuring_;
  std::optional<Failure> failure_;
  std::optional<Summary> summary_;
  std::string record_;

  // Where a new stream goes on.
  std::string token_;
  std::uint64_t token_position_ = 0;
  wire::CompensatedReader reader_at_token_;
  Handed handed_{};   // since the token
  Handed to_skip_{};  // of what comes again
  std::deque<Kept> kept_;
  std::size_t kept_bytes_ = 0;
  std::uint64_t lost_through_ = 0;  // input up to here that is no longer kept
};

}  // namespace trc::client
