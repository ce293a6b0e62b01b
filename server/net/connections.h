#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "server/net/transport_counts.h"

namespace trc::server {

// Watches the TCP connections for what HTTP/2 lets a client do at next to no cost of its own: begin
// streams and reset them before there is an answer, and send frames that carry nothing. gRPC 1.51
// bounds neither; such a connection is shut down, with all its streams. Nor may one address open so
// many that others find no descriptor left.
//
// gRPC owns the descriptors. Each is known by its number and by the number the kernel gives a
// socket for life, so that another connection with the same descriptor is left alone.
class Connections {
 public:
  struct Limits {
    std::uint32_t early_cancels = 200;  // within a window, see below
    std::uint64_t overhead_bytes_per_s = 2U << 20U;
    // Bytes beyond that which may have come and not yet be a message: of each call, and at all.
    std::uint64_t read_ahead_of_call = 1U << 20U;
    std::uint64_t read_ahead = 24U << 20U;
    std::uint32_t calls = 128;  // begun and not yet done with, whatever the client has reset
    // Bytes of unfinished messages, of all connections together; and of streams that are open,
    // also of those gRPC's own service of health has.
    std::uint64_t unfinished = 48U << 20U;
  };
  enum class Reason { early_cancels, overhead, calls, connections, unfinished };
  static constexpr std::size_t reason_count = 5;
  // Where connections are shut down: who it was, and why. Must not throw.
  using Closed = std::function<void(const std::string& peer, Reason reason)>;

  explicit Connections(const Limits& limits) : limits_(limits) {}
  // Before the first connection.
  void when_closed(Closed closed) { closed_ = std::move(closed); }

  class Connection;
  // One call of a connection, from its begin until gRPC is done with it.
  class Call {
   public:
    Call() = default;
    explicit Call(std::shared_ptr<Connection> connection) : connection_(std::move(connection)) {}
    ~Call();
    Call(Call&&) = default;
    Call& operator=(Call&&) = delete;

    // A message has come that is so large.
    void carried(std::uint64_t bytes) const;
    // `early`: reset by the client before there was anything to answer.
    void ended(bool early) const;

   private:
    std::shared_ptr<Connection> connection_;  // none: not one of TCP
  };

  enum class Use : std::uint8_t {
    work,
    // HTTP/1.1: every byte belongs to a request, which its own server bounds. It is counted, but
    // what is about frames is not looked for.
    http,
    // May take some of the descriptors that are kept, and leaves the others alone: of more than
    // most_of_health the oldest goes.
    health,
  };
  static constexpr std::size_t most_of_health = 16;
  // A descriptor that has just been accepted. False when it is to be closed: its address has so
  // many connections open already.
  [[nodiscard]] bool add(int descriptor, std::size_t most_of_one_address, Use use);
  // A call of the peer as gRPC names it: "ipv4:10.0.0.7:40000".
  [[nodiscard]] Call begin(std::string_view peer);
  // To be called several times a second: how many bytes have come, and which connections have gone.
  // True where streams have begun; then the next look should follow soon.
  [[nodiscard]] bool look();

  [[nodiscard]] std::size_t count() const;

 private:
  // With the mutex held.
  [[nodiscard]] bool has_room_for(const std::string& address, std::size_t most);
  void forget_gone();

  // Shuts the oldest one of those that ask for health where there are too many.
  void make_room_for_health();
  // Where all together have too much under way, those of which most is unfinished.
  void close_heaviest(std::vector<std::shared_ptr<Connection>> here);
  // Where all together hold too many streams, those of the addresses that hold most.
  void close_most_streams(std::vector<std::shared_ptr<Connection>> here,
                          std::chrono::steady_clock::time_point now);
  // Gives back what the calls of a connection have held that was shut down a while ago.
  void give_back_memory(std::chrono::steady_clock::time_point now);

  const Limits limits_;
  Closed closed_;
  TransportCounts counts_;  // of the thread that looks alone
  std::atomic<bool> has_shut_ = false;
  std::chrono::steady_clock::time_point gives_back_at_{};
  mutable std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<Connection>> by_peer_;
  std::unordered_map<std::string, std::size_t> of_address_;  // how many of by_peer_
  std::deque<std::weak_ptr<Connection>> of_health_;          // the oldest first
};

// "early_cancels", "overhead", "calls", "connections" or "unfinished".
[[nodiscard]] std::string_view name_of(Connections::Reason reason);

}  // namespace trc::server
