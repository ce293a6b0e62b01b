#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "server/resources/memory_budget.h"
#include "server/work/worker_pool.h"

namespace trc::server {

// A caller: the name in a client certificate, else an address, also for HTTP. The memory of all its
// streams together is limited, and they share its turns in the worker pool.
class Peer {
 public:
  // The place of one stream of the peer; an empty one holds none.
  class Place {
   public:
    Place() = default;
    explicit Place(Peer& peer) : peer_(&peer) { ++peer.streams_; }
    Place(Place&& other) noexcept : peer_(other.peer_) { other.peer_ = nullptr; }
    Place& operator=(Place&& other) noexcept {
      std::swap(peer_, other.peer_);
      return *this;
    }
    ~Place() {
      if (peer_ != nullptr) --peer_->streams_;
    }

   private:
    Peer* peer_ = nullptr;
  };

  explicit Peer(std::uint64_t most_bytes) : memory(most_bytes) {}

  [[nodiscard]] std::size_t streams() const { return streams_; }

  MemoryBudget memory;
  WorkerPool::Group turns;

 private:
  std::atomic<std::size_t> streams_ = 0;
};

// All peers with something open. None is remembered longer, so strangers leave no trace.
class Peers {
 public:
  explicit Peers(std::uint64_t most_bytes_each) : most_bytes_(most_bytes_each) {}
  // No peer may be left.
  ~Peers() = default;
  Peers(const Peers&) = delete;
  Peers& operator=(const Peers&) = delete;

  // The peer of this name, as long as somebody holds it.
  [[nodiscard]] std::shared_ptr<Peer> of(std::string_view name);
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] std::uint64_t most_bytes_each() const { return most_bytes_; }

 private:
  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::map<std::string, std::weak_ptr<Peer>, std::less<>> peers_;
};

// The peer's name for what gRPC calls it: "ipv4:192.0.2.7:40000" is 192.0.2.7, of an IPv6 address
// its network of 64 bits counts; all that come through socket files are one.
[[nodiscard]] std::string peer_of_address(std::string_view address);

// The IP address in what gRPC calls a peer, without brackets, zone and port; empty if there is
// none.
[[nodiscard]] std::string bare_address(std::string_view address);

}  // namespace trc::server
