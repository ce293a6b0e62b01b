#pragma once

#include <optional>

#include "server/rpc/setup.h"
#include "server/rpc/stream_context.h"
#include "server/rpc/stream_work.h"

namespace trc::server {

// The protocol of a stream that is compensated: the setup, which is accepted, then pieces of input,
// the last of them final. `Run` reads the contents that its RPC defines.
template <class Run>
class CompensateStream final : public StreamWork<typename Run::Request, typename Run::Response> {
 public:
  using Request = typename Run::Request;
  using Response = typename Run::Response;

  explicit CompensateStream(const StreamContext& stream) : stream_(stream) {}

  Turn take(const Request& request, Response& response) override {
    if (request.request_case() == Request::REQUEST_NOT_SET)
      return end(refuse(Refusal::request_empty, Run::what_a_request_is, {{"field", "request"}}));
    if (request.request_case() == Request::kSetup) return set_up(request.setup(), response);
    if (!run_) return setup_missing();
    run_->feed(request);
    return proceed(response);
  }

  Turn proceed(Response& response) override {
    return run_->answer(response, [&](bool last) {
      response.clear_resume_token();
      if (last && want_tokens_) *response.mutable_resume_token() = run_->resume_token(setup_);
    });
  }

  Turn ended(Response& /*response*/) override {
    if (!run_) return setup_missing();
    return end(run_->finished() ? Ending{} : refuse(Refusal::contour_incomplete));
  }

  // Opening and reading a token takes time.
  [[nodiscard]] bool is_short(const Request* request) const override {
    if (!run_) return request == nullptr || Run::path_of(request->setup()).resume_token().empty();
    return !want_tokens_ && run_->is_short(request);
  }

 private:
  using Setup = typename Run::SetupMessage;

  static Turn setup_missing() {
    return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  }

  Turn set_up(const Setup& message, Response& response) {
    stream_.record.received(0);
    if (run_) return end(refuse(Refusal::setup_repeated, {}, {{"field", "setup"}}));
    const Config& config = stream_.backend.config;
    typename Run::Settings settings;
    if (auto refused = read_setup(message, config, settings)) return end(*refused);
    const wire::PathSettings& path = Run::path_of(settings);
    stream_.record.set_client_tag(path.client_tag);
    run_.emplace(stream_, settings);
    if constexpr (requires { run_->record(message); }) run_->record(message);
    want_tokens_ = path.want_resume_tokens;
    if (want_tokens_ || !path.resume_token.empty()) {
      Setup without_token = message;
      Run::path_of(without_token).clear_resume_token();
      setup_ = ResumeTokens::digest_of(without_token);
    }
    if (!path.resume_token.empty()) {
      if (auto refused = run_->resume(path.resume_token, setup_)) return end(*refused);
    }
    response.Clear();
    accept(config, *response.mutable_accepted());
    stream_.record.sent(0);
    return {.write = true, .next = Turn::Next::read, .ending = {}};
  }

  StreamContext stream_;
  std::optional<Run> run_;
  bool want_tokens_ = false;
  ResumeTokens::Digest setup_{};  // where tokens are wanted or given
};

}  // namespace trc::server
