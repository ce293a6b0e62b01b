#include "server/rpc/preview_path.h"

#include "server/rpc/setup.h"

namespace trc::server {

Turn PreviewPath::take(const v1::PreviewPathRequest& request, v1::PreviewPathResponse& response) {
  if (const auto unknown = wire::unknown_field_in(request)) return end(refuse(*unknown));
  if (!request.has_setup()) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  wire::PathSettings settings;
  if (auto refused = read_setup(request.setup(), stream_.backend.config, settings))
    return end(*refused);
  if (auto refused = refuse_tokens(request.setup(), wire::FieldPath("setup"), "PreviewPath"))
    return end(*refused);
  stream_.record.set_client_tag(settings.client_tag);
  run_.emplace(stream_, settings);
  run_->feed(request);
  return proceed(response);
}

Turn PreviewPath::proceed(v1::PreviewPathResponse& response) { return run_->answer(response); }

Turn PreviewPath::ended(v1::PreviewPathResponse& /*response*/) { return end({}); }

}  // namespace trc::server
