#include "server/rpc/compensate_path.h"

#include "server/rpc/setup.h"

namespace trc::server {

Turn CompensatePath::take(const v1::CompensatePathRequest& request,
                          v1::CompensatePathResponse& response) {
  using Request = v1::CompensatePathRequest;
  if (request.request_case() == Request::REQUEST_NOT_SET)
    return end(refuse(Refusal::request_empty, "setup, batch or columns", {{"field", "request"}}));
  if (request.request_case() == Request::kSetup) return set_up(request.setup(), response);
  if (!run_) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  if (request.request_case() == Request::kBatch) {
    run_->feed(request.batch());
  } else {
    run_->feed(request.columns());
  }
  return proceed(response);
}

Turn CompensatePath::set_up(const v1::PathSetup& message, v1::CompensatePathResponse& response) {
  stream_.record.received(0);
  if (run_) return end(refuse(Refusal::setup_repeated, {}, {{"field", "setup"}}));
  wire::PathSettings settings;
  if (auto refused = read_setup(message, stream_.backend.config, settings)) return end(*refused);
  stream_.record.set_client_tag(settings.client_tag);
  run_.emplace(stream_, settings);
  want_tokens_ = settings.want_resume_tokens;
  if (want_tokens_ || !settings.resume_token.empty()) {
    v1::PathSetup without_token = message;
    without_token.clear_resume_token();
    setup_ = ResumeTokens::digest_of(without_token);
  }
  if (!settings.resume_token.empty()) {
    if (auto refused = run_->resume(settings.resume_token, setup_)) return end(*refused);
  }
  response.Clear();
  accept(stream_.backend.config, *response.mutable_accepted());
  stream_.record.sent(0);
  return {.write = true, .next = Turn::Next::read, .ending = {}};
}

Turn CompensatePath::proceed(v1::CompensatePathResponse& response) {
  return run_->answer(response, [&](const Outbox::Slice& /*slice*/, bool last) {
    if (last && run_->blocks_taken() > 0)
      response.set_consumed_through_block(run_->blocks_taken() - 1);
    else
      response.clear_consumed_through_block();
    response.clear_resume_token();
    if (last && want_tokens_) *response.mutable_resume_token() = run_->resume_token(setup_);
  });
}

Turn CompensatePath::ended(v1::CompensatePathResponse& /*response*/) {
  if (!run_) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  return end(run_->finished() ? Ending{} : refuse(Refusal::contour_incomplete));
}

// A token is opened, and read: not soon done.
bool CompensatePath::is_short(const v1::CompensatePathRequest* request) const {
  if (!run_) return request == nullptr || request->setup().resume_token().empty();
  if (want_tokens_) return false;
  if (request == nullptr) return run_->is_soon_done(0);
  return run_->is_soon_done(request->has_columns()
                                ? request->columns().kinds().size()
                                : static_cast<std::uint64_t>(request->batch().blocks_size()));
}

}  // namespace trc::server
