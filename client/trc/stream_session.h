#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "client/trc/answer.h"
#include "client/trc/failure.h"
#include "client/trc/stream.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::client {

// What both kinds of session share: the window of unanswered requests, reading
// responses, and how a stream ends. `Summary` is the native summary.
template <class Request, class Response, class Summary>
class StreamSession {
 public:
  template <class Start>
  StreamSession(const Position& start_position, Start start)
      : stream_(start), reader_(start_position) {}

  [[nodiscard]] Request& outgoing() { return stream_.outgoing(); }

  // Sends `outgoing`. `input_end`: the input position behind this request;
  // nothing when it is not to be waited for.
  bool send(std::optional<std::uint64_t> input_end, const AnswerSink& sink) {
    if (failure_ || finished_) return false;
    if (input_end) unanswered_.push_back(*input_end);
    const auto take = taker(sink);
    if (!stream_.send(take)) return end(sink);
    while (unanswered_.size() >= window_)
      if (!stream_.receive(take)) return end(sink);
    return true;
  }

  // Waits until the server has taken the setup: limits are known from then on.
  bool accept(const AnswerSink& sink) {
    if (failure_ || finished_) return false;
    const auto take = taker(sink);
    while (!accepted_)
      if (!stream_.receive(take)) return end(sink);
    return true;
  }

  // Hands out the rest and reads the status.
  bool finish(const AnswerSink& sink) {
    if (!failure_ && !finished_) end(sink);
    return !failure_;
  }

  [[nodiscard]] const v1::StreamAccepted& limits() const { return limits_; }
  [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
  [[nodiscard]] const std::optional<Summary>& summary() const { return summary_; }

 private:
  auto taker(const AnswerSink& sink) {
    return [this, &sink](const Response& response) { return take(response, sink); };
  }

  bool take(const Response& response, const AnswerSink& sink) {
    if (response.has_accepted()) {
      accepted_ = true;
      limits_ = response.accepted();
      window_ = std::max<std::size_t>(limits_.max_batches_in_flight(), 1);
      return true;
    }
    const std::uint64_t consumed = consumed_through(response);
    while (!unanswered_.empty() && unanswered_.front() <= consumed) unanswered_.pop_front();

    Answer answer;
    wire::FieldFaults faults;
    if (response.has_batch()) reader_.read(response.batch(), answer.blocks, faults);
    if (response.has_columns()) reader_.read(response.columns(), answer.blocks, faults);
    if (response.has_summary()) summary_ = wire::from_proto(response.summary());
    if (!faults.empty()) {
      failure_ = invalid_response(faults);
      return false;
    }
    answer.text = text_of(response);
    for (const v1::Diagnostic& diagnostic : response.diagnostics())
      answer.diagnostics.push_back(wire::from_proto(diagnostic));
    if (answer.text.empty() && answer.blocks.empty() && answer.diagnostics.empty()) return true;
    if (sink(answer)) return true;
    failure_ = Failure{
        .status = "CANCELLED", .message = "the caller wanted no more", .reason = "CALLER_STOPPED"};
    return false;
  }

  // The position behind the last input that was answered.
  static std::uint64_t consumed_through(const v1::CompensatePathResponse& response) {
    return response.has_consumed_through_block() ? response.consumed_through_block() + 1 : 0;
  }
  static std::uint64_t consumed_through(const v1::CompensateProgramResponse& response) {
    return response.consumed_bytes();
  }
  static std::string text_of(const v1::CompensatePathResponse& /*response*/) { return {}; }
  static std::string text_of(const v1::CompensateProgramResponse& response) {
    return response.nc_text();
  }

  // The stream is over, or is to be. Always false, for the caller to pass on.
  bool end(const AnswerSink& sink) {
    finished_ = true;
    if (failure_) stream_.cancel();
    const AnswerSink drop = [](const Answer&) { return true; };
    const grpc::Status status = stream_.close(taker(failure_ ? drop : sink));
    if (!failure_) failure_ = failure_of(status);
    if (!failure_ && !summary_) failure_ = missing_summary();
    if (failure_) summary_.reset();
    return false;
  }

  Stream<Request, Response> stream_;
  wire::CompensatedReader reader_;
  v1::StreamAccepted limits_;
  std::deque<std::uint64_t> unanswered_;  // input positions behind each request
  std::size_t window_ = 1;
  bool accepted_ = false;
  bool finished_ = false;
  std::optional<Failure> failure_;
  std::optional<Summary> summary_;
};

// Where a setup says the tool stands.
[[nodiscard]] inline Position start_of(const v1::PathSetup& setup) {
  const v1::Position& start = setup.start_position();
  return {start.x(), start.y(), start.z()};
}

}  // namespace trc::client
