#include "server/rpc/caller.h"

#include <grpc/grpc_security_constants.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <string_view>

#include "server/resources/peers.h"

namespace trc::server {
namespace {

// Whether gRPC uses this name for a caller within this process. gRPC in Debian 12 does not know the
// name of its own in-process transport. A caller on a port always has an address.
bool is_own_process(std::string_view peer) { return peer == "inproc" || peer == "unknown"; }

// The metadata that a call from this process carries; `otherwise` if it has none, and for other
// calls.
std::string said_by_own_process(const grpc::CallbackServerContext& context, const char* name,
                                std::string otherwise) {
  const auto found = context.client_metadata().find(name);
  if (!is_own_process(context.peer()) || found == context.client_metadata().end()) return otherwise;
  return {found->second.data(), found->second.size()};
}

// Whether a certificate carries a name. URIs are only compared with names that are URIs: a URI that
// reads like a host name must not pass for that host.
bool carries(const grpc::AuthContext& certificate, const std::string& name) {
  const auto has = [&](const char* kind) {
    const auto values = certificate.FindPropertyValues(kind);
    return std::find(values.begin(), values.end(), grpc::string_ref(name)) != values.end();
  };
  if (name.find("://") != std::string::npos) return has(GRPC_PEER_URI_PROPERTY_NAME);
  return has(GRPC_X509_CN_PROPERTY_NAME) || has(GRPC_PEER_DNS_PROPERTY_NAME) ||
         has(GRPC_PEER_IP_PROPERTY_NAME) || has(GRPC_PEER_EMAIL_PROPERTY_NAME);
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

std::string peer_of(const grpc::CallbackServerContext& context) {
  const auto caller = context.auth_context();
  if (caller != nullptr && caller->IsPeerAuthenticated())
    for (const char* property : {GRPC_X509_CN_PROPERTY_NAME, GRPC_X509_SAN_PROPERTY_NAME}) {
      const auto names = caller->FindPropertyValues(property);
      if (!names.empty() && !names.front().empty())
        return "certificate:" + std::string(names.front().data(), names.front().size());
    }
  return said_by_own_process(context, client_of_http, peer_of_address(context.peer()));
}

std::string origin_of(const grpc::CallbackServerContext& context) {
  return said_by_own_process(context, address_of_http, context.peer());
}

std::optional<Ending> refuse_caller(const grpc::CallbackServerContext& context,
                                    const std::vector<std::string>& allowed) {
  if (allowed.empty()) return std::nullopt;
  const auto caller = context.auth_context();
  if (caller == nullptr || !caller->IsPeerAuthenticated()) return std::nullopt;
  if (std::any_of(allowed.begin(), allowed.end(),
                  [&](const std::string& name) { return carries(*caller, name); }))
    return std::nullopt;
  return refuse(Refusal::client_not_allowed);
}

}  // namespace trc::server
