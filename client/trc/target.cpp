#include "client/trc/target.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

enum class Family { ipv4, ipv6, name };

// For HOST:PORT or [IPV6]:PORT.
Family family_of(const std::string& address) {
  const auto colon = address.rfind(':');
  if (colon == std::string::npos) return Family::name;
  std::string host = address.substr(0, colon);
  in6_addr number{};
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
    return inet_pton(AF_INET6, host.c_str(), &number) == 1 ? Family::ipv6 : Family::name;
  }
  return inet_pton(AF_INET, host.c_str(), &number) == 1 ? Family::ipv4 : Family::name;
}

Failure refused(std::string message) {
  return {.status = "INVALID_ARGUMENT", .message = std::move(message), .reason = "ADDRESS_INVALID"};
}

// For HOST:PORT.
std::optional<Failure> fault_of_port(const std::string& address) {
  const std::string port = address.substr(address.rfind(':') + 1);
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error == std::errc{} && end == port.data() + port.size() && number > 0) return std::nullopt;
  return refused("'" + address + "': '" + port + "' is no port: write a number from 1 to 65535");
}

// Streams go to the servers in turn, except to a server that reports on its own connection that it
// takes no work.
std::string in_turn_while_serving() {
  return R"({"loadBalancingConfig":[{"round_robin":{}}],"healthCheckConfig":{"serviceName":")" +
         std::string(v1::TrcService::service_full_name()) + R"("}})";
}

}  // namespace

std::optional<Failure> target_of(const std::string& address, bool tls, Target& target) {
  if (address.starts_with("dns:")) {
    target = {.uri = address, .service_config = in_turn_while_serving()};
    return std::nullopt;
  }
  if (const auto scheme = address.find("://"); scheme != std::string::npos)
    return refused("'" + address + "' is no address of a gRPC server: write HOST:PORT without " +
                   address.substr(0, scheme + 3));
  if (address.find(',') == std::string::npos) {
    // Without a port gRPC would use that of HTTPS.
    const bool has_port = address.find(':') != std::string::npos && !address.ends_with(']');
    if (!has_port) return refused("'" + address + "' has no port: write " + address + ":50051");
    const bool is_socket = address.starts_with("unix:") || address.starts_with("unix-abstract:") ||
                           address.starts_with("vsock:");
    if (auto fault = is_socket ? std::nullopt : fault_of_port(address)) return fault;
    target = {.uri = address, .service_config = {}};
    return std::nullopt;
  }
  if (tls)
    return refused("with TLS give one name that stands for all servers, dns:///NAME:PORT: '" +
                   address + "' has none their certificates could be checked against");
  std::istringstream list(address);
  std::vector<std::string> servers;
  for (std::string one; std::getline(list, one, ',');) {
    if (family_of(one) == Family::name)
      return refused("in a list of servers '" + one + "' must be an IP address and a port");
    if (auto fault = fault_of_port(one)) return fault;
    if (!servers.empty() && family_of(one) != family_of(servers.front()))
      return refused("'" + address + "' mixes IPv4 and IPv6");
    servers.push_back(std::move(one));
  }
  // The first session takes the server that connects first, which is usually the first in the list.
  // Without the shuffle, clients with one session each would hardly use the others.
  std::shuffle(servers.begin(), servers.end(), std::minstd_rand(std::random_device()()));
  const bool ipv6 = family_of(servers.front()) == Family::ipv6;
  target = {.uri = ipv6 ? "ipv6:" : "ipv4:", .service_config = in_turn_while_serving()};
  for (const std::string& one : servers) target.uri += (&one == &servers.front() ? "" : ",") + one;
  return std::nullopt;
}

}  // namespace trc::client
