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

// Watches TCP connections for things that HTTP/2 lets a client do at almost no cost: begin streams
// and reset them before there is an answer, and send frames that carry nothing. gRPC 1.51 bounds
// neither; such a connection is shut down, with all its streams. Nor may one address open so many
// that no descriptor is left for others.
//
// gRPC owns the descriptors. Each is known by its number and by the lifelong number of its socket
// in the kernel, so that a later connection with the same descriptor is left alone.
class Connections {
 public:
  struct Limits {
    std::uint32_t early_cancels = 200;  // within a window, see below
    std::uint64_t overhead_bytes_per_s = 2U << 20U;
    // Bytes that come while the server says nothing: above what the windows let a client send.
    std::uint64_t unheard = (2U << 20U) + (256U << 10U);
    // Bytes beyond a message that may have come without being one yet: per call, and in total.
    std::uint64_t read_ahead_of_call = 1U << 20U;
    std::uint64_t read_ahead = 24U << 20U;
    std::uint32_t calls = 128;  // begun and not yet done with, whatever the client has reset
    // Bytes of unfinished messages of all connections together; and open streams, including those
    // of gRPC's own health service.
    std::uint64_t unfinished = 48U << 20U;
  };
  enum class Reason { early_cancels, overhead, calls, connections, unfinished };
  static constexpr std::size_t reason_count = 5;
  // Called when a connection is shut down: whose it was, and why. Must not throw.
  using Closed = std::function<void(const std::string& peer, Reason reason)>;

  explicit Connections(const Limits& limits) : limits_(limits) {}
  // Before the first connection.
  void when_closed(Closed closed) { closed_ = std::move(closed); }

  class Connection;
  // One call of a connection, from its start until gRPC has released it.
  class Call {
   public:
    Call() = default;
    explicit Call(std::shared_ptr<Connection> connection) : connection_(std::move(connection)) {}
    ~Call();
    Call(Call&&) = default;
    Call& operator=(Call&&) = delete;

    enum class End : std::uint8_t {
      done,
      refused,  // by the server: the client may have sent more, which nobody takes
      early,    // reset by the client before there was anything to answer
    };

    // A message of this size has come.
    void carried(std::uint64_t bytes);
    void ended(End end) const;

   private:
    std::shared_ptr<Connection> connection_;  // none: not one of TCP
    std::uint64_t carried_ = 0;
  };

  enum class Use : std::uint8_t {
    work,
    // HTTP/1.1: every byte belongs to a request, which its own server bounds. The connection is
    // counted, but not checked for frames.
    http,
    // May use some of the reserved descriptors, and no others: beyond most_of_health the oldest is
    // closed. Not counted for its address: who has all the connections it may have is still told.
    health,
  };
  static constexpr std::size_t most_of_health = 16;
  // Adds a descriptor that has just been accepted. False when it has to be closed: its address has
  // too many connections open already.
  [[nodiscard]] bool add(int descriptor, std::size_t most_of_one_address, Use use);
  // A call of the peer as gRPC names it: "ipv4:10.0.0.7:40000".
  [[nodiscard]] Call begin(std::string_view peer);
  // To be called several times a second: how many bytes have come, and which connections have gone.
  // True where streams have begun; then the next look should follow soon.
  [[nodiscard]] bool look();

  [[nodiscard]] std::size_t count() const;

 private:
  // The mutex must be held.
  [[nodiscard]] bool has_room_for(const std::string& address, std::size_t most);
  void forget_gone();

  // Shuts down the oldest connection for health where there are too many.
  void make_room_for_health();
  // Where all together have too many unfinished bytes, shuts down those with the most.
  void close_heaviest(std::vector<std::shared_ptr<Connection>> here);
  // Where all together hold too many streams, shuts down those of the addresses with the most.
  void close_most_streams(std::vector<std::shared_ptr<Connection>> here,
                          std::chrono::steady_clock::time_point now);
  // Releases the memory of calls whose connection was shut down a while ago.
  void give_back_memory(std::chrono::steady_clock::time_point now);

  const Limits limits_;
  Closed closed_;
  TransportCounts counts_;  // of the thread that looks alone
  std::atomic<bool> has_shut_ = false;
  std::chrono::steady_clock::time_point gives_back_at_{};
  mutable std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<Connection>> by_peer_;
  std::unordered_map<std::string, std::size_t> of_address_;  // how many of by_peer_ beside health
  std::deque<std::weak_ptr<Connection>> of_health_;          // the oldest first
};

// "early_cancels", "overhead", "calls", "connections" or "unfinished".
[[nodiscard]] std::string_view name_of(Connections::Reason reason);

}  // namespace trc::server
