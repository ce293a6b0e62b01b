#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

namespace trc::server {

// The counts that gRPC keeps of its connections (channelz), including streams that it has not
// handed over yet: it reads frames much faster than it hands calls over.
class TransportCounts {
 public:
  struct Streams {
    std::uint64_t started = 0;
    std::uint64_t succeeded = 0;  // ended by the server
    std::uint64_t failed = 0;     // reset, or lost with the connection

    // The streams that gRPC has not released, whose memory it holds.
    [[nodiscard]] std::uint64_t alive() const { return started - succeeded - failed; }
  };

  // From now on gRPC may be asked once more for its connections.
  void begin_round() { is_fresh_ = false; }
  // The number gRPC has given the connection of a peer, "ipv4:10.0.0.7:40000"; none when it knows
  // no such connection.
  [[nodiscard]] std::optional<std::int64_t> number_of(const std::string& peer);
  [[nodiscard]] static std::optional<Streams> streams_of(std::int64_t number);
  void forget(const std::string& peer) { numbers_.erase(peer); }

 private:
  void read_numbers();

  bool is_fresh_ = false;
  std::unordered_map<std::string, std::int64_t> numbers_;
};

}  // namespace trc::server
