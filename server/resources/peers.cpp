#include "server/resources/peers.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace trc::server {

std::shared_ptr<Peer> Peers::of(std::string_view name) {
  const auto forget = [this, key = std::string(name)](Peer* peer) {
    {
      const std::lock_guard gone(mutex_);
      const auto found = peers_.find(key);
      // Another peer of this name may have come meanwhile.
      if (found != peers_.end() && found->second.expired()) peers_.erase(found);
    }
    delete peer;
  };
  // Before the lock: if the new peer is not needed, its deleter takes the lock.
  std::shared_ptr<Peer> peer(new Peer(most_bytes_), forget);
  const std::lock_guard lock(mutex_);
  std::weak_ptr<Peer>& known = peers_[std::string(name)];
  if (auto there = known.lock()) return there;
  known = peer;
  return peer;
}

std::size_t Peers::count() const {
  const std::lock_guard lock(mutex_);
  return peers_.size();
}

std::string bare_address(std::string_view address) {
  const std::size_t kind_end = address.find(':');
  const std::string_view kind = address.substr(0, kind_end);
  if (kind != "ipv4" && kind != "ipv6") return {};
  const std::string_view host = address.substr(kind_end + 1, address.rfind(':') - kind_end - 1);
  if (kind == "ipv4") return std::string(host);
  // The address is in brackets, which gRPC writes as %5B and %5D, and may have a zone.
  std::string bare(host);
  for (const std::string_view bracket : {"%5B", "%5D", "[", "]"})
    if (const std::size_t at = bare.find(bracket); at != std::string::npos)
      bare.erase(at, bracket.size());
  return bare.substr(0, bare.find('%'));
}

std::string peer_of_address(std::string_view address) {
  const std::string_view kind = address.substr(0, address.find(':'));
  std::string bare = bare_address(address);
  if (bare.empty()) return std::string(kind);
  if (kind == "ipv4") return bare;
  constexpr std::size_t network_bytes = 8;
  std::array<unsigned char, 16> bytes{};
  if (inet_pton(AF_INET6, bare.c_str(), bytes.data()) != 1) return bare;
  // An IPv4 address mapped to IPv6.
  if (bare.starts_with("::ffff:") && bare.find('.') != std::string::npos) return bare.substr(7);
  std::fill(bytes.begin() + network_bytes, bytes.end(), static_cast<unsigned char>(0));
  std::array<char, INET6_ADDRSTRLEN> text{};
  return std::string(inet_ntop(AF_INET6, bytes.data(), text.data(), text.size())) + "/64";
}

}  // namespace trc::server
