#include "server/rpc/caller.h"

#include <grpc/grpc_security_constants.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <string_view>

namespace trc::server {
namespace {

bool is_among(const std::vector<grpc::string_ref>& names, const std::vector<std::string>& allowed) {
  return std::any_of(names.begin(), names.end(), [&](const grpc::string_ref& name) {
    return std::find(allowed.begin(), allowed.end(), std::string_view(name.data(), name.size())) !=
           allowed.end();
  });
}

}  // namespace

Trace trace_of(grpc::CallbackServerContext& context) {
  const auto found = context.client_metadata().find("traceparent");
  const bool given = found != context.client_metadata().end();
  Trace trace = trace_of(given ? std::string_view(found->second.data(), found->second.size())
                               : std::string_view());
  context.AddInitialMetadata("trace-id", trace.trace_id);
  return trace;
}

std::optional<Ending> refuse_caller(const grpc::CallbackServerContext& context,
                                    const std::vector<std::string>& allowed) {
  if (allowed.empty()) return std::nullopt;
  const auto caller = context.auth_context();
  if (caller == nullptr || !caller->IsPeerAuthenticated()) return std::nullopt;
  if (is_among(caller->FindPropertyValues(GRPC_X509_CN_PROPERTY_NAME), allowed) ||
      is_among(caller->FindPropertyValues(GRPC_X509_SAN_PROPERTY_NAME), allowed))
    return std::nullopt;
  return refuse(Refusal::client_not_allowed);
}

}  // namespace trc::server
