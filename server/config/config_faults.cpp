#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/config/config.h"
#include "server/config/plain_file.h"
#include "server/net/address.h"

namespace trc::server {
namespace {

std::optional<std::string> fault_of_address(const std::string& address) {
  if (address.starts_with(unix_prefix)) {
    const std::size_t length = address.size() - unix_prefix.size();
    if (length == 0) return "listen: '" + address + "' names no path";
    if (length > longest_unix_path)
      return "listen: the path of '" + address + "' is longer than 107 bytes";
    return std::nullopt;
  }
  if (!split_host_port(address))
    return "listen: '" + address + "' is not HOST:PORT, [IPV6]:PORT or unix:/path";
  return std::nullopt;
}

// A port without TLS: HOST:PORT of this machine, unless `allowed`; empty: no port.
std::optional<std::string> fault_of_plain_port(const std::string& name, const std::string& address,
                                               const std::string& permission, bool allowed) {
  if (address.empty()) return std::nullopt;
  if (!split_host_port(address)) return name + ": '" + address + "' is not HOST:PORT";
  if (allowed || is_local_address(address)) return std::nullopt;
  return name + ": '" + address +
         "' can be reached by other machines in plain text; allow that with " + permission;
}

std::optional<std::string> fault_of_file(const std::string& name, const std::string& path) {
  if (path.empty()) return std::nullopt;
  std::string fault = PlainFile::read(path).fault_of(name, path);
  if (fault.empty()) return std::nullopt;
  return fault;
}

std::optional<std::string> fault_of_http(const Config& config, bool tls) {
  if (config.http_listen.empty()) return std::nullopt;
  if (!split_host_port(config.http_listen))
    return "http-listen: '" + config.http_listen + "' is not HOST:PORT";
  if (!tls && !is_local_address(config.http_listen) && !config.insecure_http)
    return "http-listen: '" + config.http_listen +
           "' can be reached by other machines; give tls-cert-file and tls-key-file, or allow "
           "plain text with insecure-http";
  return std::nullopt;
}

bool is_host_of_origin(std::string_view host) {
  const std::string_view allowed =
      host.starts_with('[') ? "0123456789abcdef:[]" : "abcdefghijklmnopqrstuvwxyz0123456789-._";
  return !host.empty() && host.find_first_not_of(allowed) == std::string_view::npos;
}

// A host, with a port if it is not the usual one.
bool is_rest_of_origin(std::string_view rest, std::string_view usual_port) {
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos || rest.ends_with(']')) return is_host_of_origin(rest);
  const std::string_view port = rest.substr(colon + 1);
  return split_host_port(std::string(rest)) && !port.starts_with('0') && port != usual_port &&
         is_host_of_origin(rest.substr(0, colon));
}

// The origin as browsers write it (RFC 6454, 6.2), because it is compared byte by byte.
bool is_origin(std::string_view text) {
  constexpr std::string_view https = "https://";
  constexpr std::string_view http = "http://";
  if (text.starts_with(https)) return is_rest_of_origin(text.substr(https.size()), "443");
  return text.starts_with(http) && is_rest_of_origin(text.substr(http.size()), "80");
}

// The origin that was probably meant; empty: no guess.
std::string meant_origin(std::string_view text) {
  std::string meant = text.find("://") == std::string_view::npos ? "https://" : "";
  meant += text;
  for (char& c : meant)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::size_t end = meant.find('/', meant.find("://") + 3);
  if (end != std::string::npos) meant.resize(end);
  const std::string_view usual_port = meant.starts_with("https:") ? ":443" : ":80";
  if (meant.ends_with(usual_port)) meant.resize(meant.size() - usual_port.size());
  return is_origin(meant) ? meant : std::string();
}

std::optional<std::string> fault_of_origins(const std::vector<std::string>& origins) {
  for (const std::string& origin : origins) {
    if (is_origin(origin)) continue;
    const std::string meant = meant_origin(origin);
    return "http-cors-origins: '" + origin +
           "' is no origin as browsers send it: https:// or http://, the host in small letters, a "
           "port if it is not the usual one, and nothing after it; write " +
           (meant.empty() ? "it as in https://mes.example" : meant);
  }
  return std::nullopt;
}

std::optional<std::string> fault_of_proxies(const std::vector<std::string>& proxies) {
  for (const std::string& proxy : proxies)
    if (!is_network(proxy))
      return "trusted-proxies: '" + proxy +
             "' is no address and no network; write it as in 10.0.0.5 or 10.0.0.0/8";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> first_fault(const Config& config) {
  if (config.listen.empty()) return "listen: at least one address is needed";
  for (const std::string& address : config.listen)
    if (auto fault = fault_of_address(address)) return fault;
  if (auto fault = fault_of_plain_port("admin-listen", config.admin_listen, "insecure-admin",
                                       config.insecure_admin || config.insecure))
    return fault;
  if (auto fault = fault_of_plain_port("health-listen", config.health_listen, "insecure-health",
                                       config.insecure_health || config.insecure))
    return fault;

  const bool tls = !config.tls_cert_file.empty();
  if (auto fault = fault_of_http(config, tls)) return fault;
  if (auto fault = fault_of_origins(config.http_cors_origins)) return fault;
  if (auto fault = fault_of_proxies(config.trusted_proxies)) return fault;
  if (tls != !config.tls_key_file.empty())
    return "tls-cert-file and tls-key-file must be given together";
  if (!tls && !config.tls_client_ca_file.empty())
    return "tls-client-ca-file needs tls-cert-file and tls-key-file";
  if (!config.tls_allowed_clients.empty() && config.tls_client_ca_file.empty())
    return "tls-allowed-clients needs tls-client-ca-file";
  for (const auto& [name, path] :
       {std::pair<const char*, const std::string&>{"tls-cert-file", config.tls_cert_file},
        {"tls-key-file", config.tls_key_file},
        {"tls-client-ca-file", config.tls_client_ca_file}})
    if (auto fault = fault_of_file(name, path)) return fault;

  if (!tls && !config.insecure) {
    for (const std::string& address : config.listen)
      if (!is_local_address(address))
        return "listen: '" + address +
               "' can be reached by other machines; give tls-cert-file and tls-key-file, or allow "
               "plain text with insecure";
  }
  return std::nullopt;
}

}  // namespace trc::server
