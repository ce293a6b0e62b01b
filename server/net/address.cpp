#include "server/net/address.h"

#include <charconv>
#include <system_error>

namespace trc::server {

std::optional<HostPort> split_host_port(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  std::string host = address.substr(0, colon);
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed)
    host = host.substr(1, host.size() - 2);
  else if (host.find(':') != std::string::npos)
    return std::nullopt;

  const std::string_view digits = std::string_view(address).substr(colon + 1);
  std::uint16_t port = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (fault != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return HostPort{.host = host, .port = port};
}

bool is_local_address(const std::string& address) {
  if (address.starts_with(unix_prefix)) return true;
  const auto parts = split_host_port(address);
  if (!parts) return false;
  // A host name may also begin with 127.
  const bool numeric = parts->host.find_first_not_of("0123456789.") == std::string::npos;
  return parts->host == "localhost" || parts->host == "::1" ||
         (numeric && parts->host.starts_with("127."));
}

}  // namespace trc::server
