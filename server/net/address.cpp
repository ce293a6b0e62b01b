#include "server/net/address.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

namespace trc::server {
namespace {

using AddressBytes = std::array<unsigned char, 16>;
constexpr std::size_t ipv4_at = 12;  // of an IPv4 address mapped to IPv6

struct Network {
  AddressBytes bytes{};
  std::size_t bits = 0;  // those that all its addresses share
};

// A network of a single address.
std::optional<Network> address_of(const std::string& text) {
  Network one{.bytes = {}, .bits = one.bytes.size() * 8};
  if (inet_pton(AF_INET6, text.c_str(), one.bytes.data()) == 1) return one;
  one.bytes[ipv4_at - 2] = one.bytes[ipv4_at - 1] = 0xFF;
  if (inet_pton(AF_INET, text.c_str(), one.bytes.data() + ipv4_at) == 1) return one;
  return std::nullopt;
}

std::optional<Network> network_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::string base(text.substr(0, slash));
  auto network = address_of(base);
  if (!network || slash == std::string_view::npos) return network;
  const std::string_view digits = text.substr(slash + 1);
  std::size_t bits = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), bits);
  if (fault != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  if (base.find(':') == std::string::npos) bits += ipv4_at * 8;
  if (bits > network->bits) return std::nullopt;
  network->bits = bits;
  return network;
}

}  // namespace

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

bool is_network(std::string_view text) { return network_of(text).has_value(); }

bool is_in_network(std::string_view address, std::string_view network) {
  const auto one = address_of(std::string(address));
  const auto all = network_of(network);
  if (!one || !all) return false;
  const std::size_t whole = all->bits / 8;
  if (!std::equal(one->bytes.begin(), one->bytes.begin() + static_cast<std::ptrdiff_t>(whole),
                  all->bytes.begin()))
    return false;
  const std::size_t rest = all->bits % 8;
  return rest == 0 || (one->bytes.at(whole) ^ all->bytes.at(whole)) >> (8 - rest) == 0;
}

}  // namespace trc::server
