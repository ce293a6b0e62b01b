#include "client/trc/survey.h"

#include <grpcpp/channel.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include "client/trc/resume_clock.h"
#include "client/trc/stream.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

using Request = v1::SurveyRadiiRequest;
using Response = v1::SurveyRadiiResponse;

// As of RemoteProgramSession.
constexpr std::size_t chunk_bytes = 64 * 1024;

// Asks one server, once.
std::optional<Failure> ask(const Connection& connection, const v1::SurveySetup& setup,
                           std::string_view text, const SurveySink& sink) {
  const auto stub = v1::TrcService::NewStub(connection.channel());
  Stream<Request, Response> stream(
      [&stub](auto* context, auto* reactor) { stub->async()->SurveyRadii(context, reactor); });
  bool whole = false;
  bool wanted = true;
  const auto take = [&](const Response& response) {
    whole = whole || response.has_summary();
    wanted = response.has_accepted() || response.has_heartbeat() || sink(response);
    return wanted;
  };
  Request request;
  *request.mutable_setup() = setup;
  bool open = stream.send(request, take);
  for (std::size_t at = 0; open;) {
    const std::string_view chunk = text.substr(at, std::min(chunk_bytes, text.size() - at));
    v1::ProgramText& message = *request.mutable_text();
    message.set_first_byte(at);
    message.set_text(chunk.data(), chunk.size());
    at += chunk.size();
    message.set_final(at == text.size());
    open = stream.send(request, take);
    if (at == text.size()) break;
  }
  if (!wanted) stream.cancel();
  auto failure = failure_of(stream.close(take));
  if (failure) return failure;
  return whole ? std::nullopt : std::optional(missing_summary());
}

}  // namespace

std::optional<Failure> survey_program(const Connection& connection, const v1::SurveySetup& setup,
                                      std::string_view text, const SurveySink& sink) {
  const ResumePolicy& policy = connection.resume_policy();
  ResumeClock clock(policy);
  const bool reached = connection.reach();
  bool answered = false;
  for (;;) {
    auto failure = ask(connection, setup, text, [&](const v1::SurveyRadiiResponse& response) {
      answered = true;
      return sink(response);
    });
    if (!failure || answered || policy.patience <= policy.patience.zero()) return failure;
    if (!failure->asks_to_wait() && !(reached && failure->not_taken())) return failure;
    if (policy.waiting) policy.waiting(*failure);
    if (!clock.wait(failure->retry_after_seconds)) return failure;
  }
}

}  // namespace trc::client
