#include "server/rpc/caller.h"

#include <grpc/grpc_security_constants.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "server/net/address.h"
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

// The address that a proxy names as that of its client; empty if the call came from elsewhere, or
// if it names none. Each proxy adds the address it sees at the end; what stands before that may
// have been made up by the client.
std::string address_behind_proxy(const grpc::CallbackServerContext& context,
                                 const std::vector<std::string>& proxies) {
  if (proxies.empty()) return {};
  const std::string proxy = bare_address(context.peer());
  if (std::none_of(proxies.begin(), proxies.end(),
                   [&](const std::string& network) { return is_in_network(proxy, network); }))
    return {};
  const auto [first, last] = context.client_metadata().equal_range("x-forwarded-for");
  if (first == last) return {};
  const grpc::string_ref said = std::prev(last)->second;
  std::string_view address(said.data(), said.size());
  address.remove_prefix(address.find_last_of(", ") + 1);
  return is_in_network(address, address) ? std::string(address) : std::string();
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

std::string peer_of(const grpc::CallbackServerContext& context,
                    const std::vector<std::string>& proxies) {
  const auto caller = context.auth_context();
  if (caller != nullptr && caller->IsPeerAuthenticated())
    for (const char* property : {GRPC_X509_CN_PROPERTY_NAME, GRPC_X509_SAN_PROPERTY_NAME}) {
      const auto names = caller->FindPropertyValues(property);
      if (!names.empty() && !names.front().empty())
        return "certificate:" + std::string(names.front().data(), names.front().size());
    }
  if (const std::string client = address_behind_proxy(context, proxies); !client.empty()) {
    const bool is_ipv6 = client.find(':') != std::string::npos;
    return peer_of_address(is_ipv6 ? "ipv6:[" + client + "]:0" : "ipv4:" + client + ":0");
  }
  return said_by_own_process(context, client_of_http, peer_of_address(context.peer()));
}

std::string origin_of(const grpc::CallbackServerContext& context,
                      const std::vector<std::string>& proxies) {
  const std::string origin = said_by_own_process(context, address_of_http, context.peer());
  const std::string client = address_behind_proxy(context, proxies);
  return client.empty() ? origin : client + " behind " + origin;
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
