#include "client/trc/survey.h"

#include <google/protobuf/util/message_differencer.h>
#include <grpcpp/channel.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "client/trc/message_size.h"
#include "client/trc/resume_clock.h"
#include "client/trc/stream.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

using Request = v1::SurveyRadiiRequest;
using Response = v1::SurveyRadiiResponse;
using google::protobuf::util::MessageDifferencer;

// The number of these responses depends on how the text was cut, which varies.
bool says_nothing(const Response& response) {
  const bool is_of_the_stream = response.has_accepted() || response.has_heartbeat() ||
                                response.response_case() == Response::RESPONSE_NOT_SET;
  return is_of_the_stream && response.diagnostics().empty();
}

// Asks the server once.
std::optional<Failure> ask(const Connection& connection, const v1::SurveySetup& setup,
                           std::string_view text, const SurveySink& sink) {
  const auto stub = v1::TrcService::NewStub(connection.channel());
  Stream<Request, Response> stream(
      [&stub](auto* context, auto* reactor) { stub->async()->SurveyRadii(context, reactor); });
  bool accepted = false;
  bool whole = false;
  bool wanted = true;
  MessageSize message_size;
  const auto take = [&](const Response& response) {
    if (response.has_accepted()) message_size.take(response.accepted());
    accepted = accepted || response.has_accepted();
    whole = whole || response.has_summary();
    wanted = says_nothing(response) || sink(response);
    return wanted;
  };
  Request request;
  *request.mutable_setup() = setup;
  bool open = stream.send(request, take);
  for (std::size_t at = 0; open;) {
    const std::string_view chunk = text.substr(at, message_size.text_bytes());
    v1::ProgramText& message = *request.mutable_text();
    message.set_first_byte(at);
    message.set_text(chunk.data(), chunk.size());
    at += chunk.size();
    message.set_final(at == text.size());
    open = stream.send(request, take);
    if (at == text.size()) break;
    while (open && !accepted) open = stream.receive(take);
  }
  if (!wanted) stream.cancel();
  auto failure = failure_of(stream.close(take));
  if (failure) return failure;
  return whole ? std::nullopt : std::optional(missing_summary());
}

// Compares the responses, except for the time taken.
bool is_the_same(const Response& before, const Response& again) {
  MessageDifferencer differencer;
  differencer.IgnoreField(v1::SurveySummary::descriptor()->FindFieldByNumber(
      v1::SurveySummary::kWallTimeSecondsFieldNumber));
  return differencer.Compare(before, again);
}

// The responses handed to the caller. A repeated survey begins anew: responses that come again are
// compared with these and not handed on.
class Handed {
 public:
  explicit Handed(const SurveySink& sink) : sink_(sink) {}

  // The sink for the next attempt.
  [[nodiscard]] SurveySink again() {
    at_ = 0;
    progress_ = false;
    return [this](const Response& response) { return take(response); };
  }
  [[nodiscard]] bool any() const { return !answers_.empty(); }
  // Whether the last attempt got further than all earlier ones.
  [[nodiscard]] bool progress() const { return progress_; }
  [[nodiscard]] bool differs() const { return differs_; }
  [[nodiscard]] bool unwanted() const { return unwanted_; }

 private:
  bool take(const Response& response) {
    if (at_ < answers_.size()) {
      differs_ = !is_the_same(answers_[at_++], response);
      return !differs_;
    }
    answers_.push_back(response);
    ++at_;
    progress_ = true;
    unwanted_ = !sink_(response);
    return !unwanted_;
  }

  const SurveySink& sink_;
  std::vector<Response> answers_{};
  std::size_t at_ = 0;
  bool progress_ = false;
  bool differs_ = false;
  bool unwanted_ = false;
};

std::optional<Failure> ask_in_time(ResumeClock& clock, const Connection& connection,
                                   const v1::SurveySetup& setup, std::string_view text,
                                   const SurveySink& sink) {
  const ResumeClock::Attempt attempt(clock);
  return ask(connection, setup, text, sink);
}

}  // namespace

std::optional<Failure> survey_program(const Connection& connection, const v1::SurveySetup& setup,
                                      std::string_view text, const SurveySink& sink) {
  const ResumePolicy& policy = connection.resume_policy();
  ResumeClock clock(policy);
  const bool reached = connection.reach();
  Handed handed(sink);
  for (;;) {
    auto failure = ask_in_time(clock, connection, setup, text, handed.again());
    if (handed.differs()) return resumed_path_differs();
    if (!failure || handed.unwanted() || policy.patience <= policy.patience.zero()) return failure;
    const bool lost = handed.any() && failure->stream_lost();
    if (!lost && !failure->asks_to_wait() && !(reached && failure->not_taken())) return failure;
    if (handed.progress()) clock.restart();
    if (policy.waiting) policy.waiting(*failure);
    if (!clock.wait(failure->retry_after_seconds)) return failure;
  }
}

}  // namespace trc::client
