#include <utility>

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

// A port without TLS: HOST:PORT of this machine, unless more is allowed; empty: none.
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
  const std::string fault = PlainFile::read(path).fault;
  if (fault.empty()) return std::nullopt;
  return name + ": cannot read '" + path + "': " + fault;
}

std::optional<std::string> fault_of_http(const Config& config, bool tls) {
  if (config.http_listen.empty()) return std::nullopt;
  if (!split_host_port(config.http_listen))
    return "http-listen: '" + config.http_listen + "' is not HOST:PORT";
  if (!tls && !is_local_address(config.http_listen) && !config.insecure_http)
    return "http-listen: '" + config.http_listen +
           "' can be reached by other machines; give tls-cert-file and tls-key-file, or allow "
           "plain text with insecure-http";
  for (const std::string& origin : config.http_cors_origins)
    if (!origin.starts_with("https://") && !origin.starts_with("http://"))
      return "http-cors-origins: '" + origin + "' is no origin, as in https://mes.example";
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
