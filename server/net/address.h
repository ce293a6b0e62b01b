#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trc::server {

inline constexpr std::string_view unix_prefix = "unix:";
// Length of sun_path without its closing zero.
inline constexpr std::size_t longest_unix_path = 107;

struct HostPort {
  std::string host;
  std::uint16_t port = 0;
};

// HOST:PORT or [IPV6]:PORT.
[[nodiscard]] std::optional<HostPort> split_host_port(const std::string& address);

// True when an address can be reached from this machine only: a loopback address or a Unix socket.
[[nodiscard]] bool is_local_address(const std::string& address);

// An address, as in 10.0.0.5 or fd00::5, or a network, as in 10.0.0.0/8.
[[nodiscard]] bool is_network(std::string_view text);

// Whether an address lies in a network; not if one of them is none. An IPv4 address and the same
// one mapped to IPv6 are one.
[[nodiscard]] bool is_in_network(std::string_view address, std::string_view network);

}  // namespace trc::server
