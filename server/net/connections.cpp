#include "server/net/connections.h"

#include <arpa/inet.h>
#include <linux/tcp.h>
#include <malloc.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/resources/peers.h"

namespace trc::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds window{10};
// A connection that has received no more than this besides messages since gRPC was last asked about
// it has not begun many streams: each needs a head of at least some fifteen bytes.
constexpr double idle_bytes = 2 << 10;
// Time until the calls of a connection that was shut down have ended.
constexpr std::chrono::seconds clearing{5};
// Allows for frames and TLS records around small messages.
constexpr double bytes_for_a_byte = 1.5;
// Further bytes of a call, of a message, and of a second of pings and window updates.
constexpr double bytes_of_call = 1024;
constexpr double bytes_of_message = 64;
constexpr double bytes_of_second = 64 << 10;
// Measured: 17 KiB for an idle stream, 46 KiB with an answer of GetServerInfo.
constexpr std::uint64_t bytes_of_open_stream = 36U << 10U;
// A connection with fewer unfinished bytes is not the one that fills the buffers.
constexpr double least_to_close = 1 << 20;

// The kernel's unique number of this socket; none: the descriptor is no socket.
std::optional<std::uint64_t> cookie_of(int descriptor) {
  std::uint64_t cookie = 0;
  socklen_t size = sizeof(cookie);
  if (getsockopt(descriptor, SOL_SOCKET, SO_COOKIE, &cookie, &size) != 0) return std::nullopt;
  return cookie;
}

// The bytes from the other side, and those that it has acknowledged.
struct Exchanged {
  std::uint64_t received = 0;
  std::uint64_t heard = 0;
};
std::optional<Exchanged> bytes_exchanged(int descriptor) {
  tcp_info info{};
  socklen_t size = sizeof(info);
  if (getsockopt(descriptor, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  return Exchanged{.received = info.tcpi_bytes_received, .heard = info.tcpi_bytes_acked};
}

// Bytes that have arrived and that gRPC has not read.
int bytes_unread(int descriptor) {
  int bytes = 0;
  return ioctl(descriptor, FIONREAD, &bytes) == 0 ? bytes : 0;
}

std::string name_of(const char* kind, const void* address, int family, in_port_t port) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  inet_ntop(family, address, text.data(), text.size());
  const bool six = family == AF_INET6;
  return std::string(kind) + (six ? "%5B" : "") + text.data() + (six ? "%5D" : "") + ':' +
         std::to_string(ntohs(port));
}

// The peer as gRPC names it; empty: no TCP socket. A local IPv6 address with a zone does not have
// this name and is not watched.
std::string peer_name(int descriptor) {
  sockaddr_storage peer{};
  socklen_t size = sizeof(peer);
  if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) != 0) return {};
  if (peer.ss_family == AF_INET) {
    const auto& address = *reinterpret_cast<const sockaddr_in*>(&peer);
    return name_of("ipv4:", &address.sin_addr, AF_INET, address.sin_port);
  }
  if (peer.ss_family != AF_INET6) return {};
  const auto& address = *reinterpret_cast<const sockaddr_in6*>(&peer);
  return name_of("ipv6:", &address.sin6_addr, AF_INET6, address.sin6_port);
}

}  // namespace

std::string_view name_of(Connections::Reason reason) {
  switch (reason) {
    case Connections::Reason::early_cancels:
      return "early_cancels";
    case Connections::Reason::overhead:
      return "overhead";
    case Connections::Reason::calls:
      return "calls";
    case Connections::Reason::connections:
      return "connections";
    case Connections::Reason::unfinished:
      return "unfinished";
  }
  return "";
}

class Connections::Connection {
 public:
  Connection(Connections& all, int descriptor, std::uint64_t cookie, std::string peer, Use use)
      : all_(all),
        descriptor_(descriptor),
        cookie_(cookie),
        peer_(std::move(peer)),
        address_(peer_of_address(peer_)),
        use_(use) {}

  [[nodiscard]] bool is_there() const { return cookie_of(descriptor_) == cookie_; }

  void call_begins() {
    if (++calls_ > all_.limits_.calls) close(Reason::calls);
  }
  void call_done() { --calls_; }
  void carried(std::uint64_t bytes) {
    carried_ += bytes;
    ++messages_;
  }
  [[nodiscard]] bool is_shut() const { return shut_; }
  [[nodiscard]] const std::string& address() const { return address_; }
  [[nodiscard]] Use use() const { return use_; }
  // Streams that gRPC held when it was last asked.
  [[nodiscard]] std::uint64_t alive() const { return alive_; }
  // Bytes of messages that are not complete yet.
  [[nodiscard]] double unfinished() const { return unfinished_; }

  // `carried`: bytes of messages of the call.
  void call_ended(Call::End end, std::uint64_t carried) {
    // What is on its way is let pass, but not much for a call that has carried little.
    constexpr std::uint64_t times_carried = 4;
    const bool early = end == Call::End::early;
    if (end == Call::End::refused)
      sent_ahead_ += std::min(all_.limits_.read_ahead_of_call, times_carried * carried);
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (now - window_begin_ > window) {
      window_begin_ = now;
      ended_ = 0;
      early_ = 0;
    }
    ++ended_;
    ++calls_ended_;
    if (early) ++early_;
    // A client that cancels fewer than half of its calls is harmless, however many it makes.
    if (early_ > all_.limits_.early_cancels && 2 * early_ > ended_) close(Reason::early_cancels);
  }

  // Checks the bytes beyond those of messages against the present allowance. True if streams may
  // have begun.
  bool look(Clock::time_point now, TransportCounts& counts) {
    if (use_ == Use::http) return false;
    if (!shut_) count(now);
    const bool has_begun = !shut_ && unasked_ > idle_bytes;
    if (has_begun) look_at_streams(now, counts);
    if (shut_) discard();
    return has_begun;
  }

  void close(Reason reason) {
    if (shut_.exchange(true)) return;
    all_.has_shut_ = true;
    if (is_there()) shutdown(descriptor_, SHUT_RDWR);
    if (all_.closed_) all_.closed_(peer_, reason);
  }

  // Counts streams that began but were not ended by the server: streams that the client has reset,
  // and the few open ones.
  void look_at_streams(Clock::time_point now, TransportCounts& counts) {
    const auto number = counts.number_of(peer_);
    const auto streams = number ? TransportCounts::streams_of(*number) : std::nullopt;
    alive_ = streams ? streams->alive() : 0;
    if (!streams) return counts.forget(peer_);
    // gRPC reads some connections later than others: what it has not read may still begin streams.
    unasked_ = static_cast<double>(bytes_unread(descriptor_));
    if (now - streams_since_ > window) {
      streams_since_ = now;
      streams_ = *streams;
    }
    const std::uint64_t started = streams->started - streams_.started;
    const std::uint64_t succeeded = streams->succeeded - streams_.succeeded;
    const std::uint64_t open = all_.limits_.calls;
    if (started > succeeded + open + all_.limits_.early_cancels && started > 2 * succeeded)
      close(Reason::early_cancels);
    // These include streams that were never reported to the server or that gRPC serves itself.
    if (alive_ > open) close(Reason::calls);
  }

 private:
  void count(Clock::time_point now) {
    const auto exchanged = bytes_exchanged(descriptor_);
    if (!exchanged) return;
    const double seconds = std::chrono::duration<double>(now - looked_at_).count();
    const auto more = static_cast<double>(exchanged->received - received_);
    const auto carried = static_cast<double>(carried_.exchange(0));
    const auto sent_ahead = static_cast<double>(sent_ahead_.exchange(0));
    looked_at_ = now;
    received_ = exchanged->received;
    count_unheard(*exchanged);
    overhead_ += more - bytes_for_a_byte * carried - sent_ahead -
                 seconds * static_cast<double>(all_.limits_.overhead_bytes_per_s);
    overhead_ = std::max(overhead_, 0.0);
    unfinished_ += more - bytes_for_a_byte * carried - sent_ahead - seconds * bytes_of_second -
                   static_cast<double>(messages_.exchange(0)) * bytes_of_message -
                   static_cast<double>(calls_ended_.exchange(0)) * bytes_of_call;
    unfinished_ = std::max(unfinished_, 0.0);
    const std::uint64_t read_ahead =
        all_.limits_.read_ahead + calls_ * all_.limits_.read_ahead_of_call;
    if (overhead_ > static_cast<double>(read_ahead)) close(Reason::overhead);
    unasked_ += std::max(more - bytes_for_a_byte * carried, 0.0);
  }

  // A client may send no more than the window of a message before gRPC tells it that there is room
  // again. A header has no window: one that never ends is all that may go on without an answer.
  void count_unheard(const Exchanged& exchanged) {
    if (exchanged.heard != heard_) {
      heard_ = exchanged.heard;
      received_when_heard_ = exchanged.received;
    }
    const std::uint64_t unheard = exchanged.received - received_when_heard_;
    const std::uint64_t most = all_.limits_.unheard;
    if (unheard > most && unheard > most + static_cast<std::uint64_t>(bytes_unread(descriptor_)))
      close(Reason::overhead);
  }

  // gRPC reads a connection that was shut down to its end, and a flood leaves megabytes behind.
  // Runs in the thread that accepts, so that no new connection has taken over the descriptor.
  void discard() const {
    constexpr std::size_t all = std::size_t{1} << 30U;
    while (is_there() && recv(descriptor_, nullptr, all, MSG_DONTWAIT | MSG_TRUNC) > 0) {
    }
  }

  Connections& all_;
  const int descriptor_;
  const std::uint64_t cookie_;
  const std::string peer_;
  const std::string address_;
  const Use use_;
  std::atomic<std::uint32_t> calls_ = 0;
  std::atomic<std::uint64_t> carried_ = 0;
  std::atomic<std::uint64_t> sent_ahead_ = 0;  // bytes of calls that were refused meanwhile
  std::atomic<std::uint64_t> messages_ = 0;
  std::atomic<std::uint64_t> calls_ended_ = 0;
  std::atomic<bool> shut_ = false;

  std::mutex mutex_;
  Clock::time_point window_begin_ = Clock::now();
  std::uint64_t ended_ = 0;
  std::uint64_t early_ = 0;

  // Used only by the thread that calls look().
  Clock::time_point looked_at_ = Clock::now();
  std::uint64_t received_ = 0;
  std::uint64_t heard_ = 0;
  std::uint64_t received_when_heard_ = 0;
  double overhead_ = 0;
  double unfinished_ = 0;
  // Bytes besides messages that may have begun streams since gRPC was asked about them.
  double unasked_ = 0;
  std::uint64_t alive_ = 0;
  Clock::time_point streams_since_ = Clock::now();
  TransportCounts::Streams streams_{};
};

Connections::Call::~Call() {
  if (connection_ != nullptr) connection_->call_done();
}
void Connections::Call::carried(std::uint64_t bytes) {
  carried_ += bytes;
  if (connection_ != nullptr) connection_->carried(bytes);
}
void Connections::Call::ended(End end) const {
  if (connection_ != nullptr) connection_->call_ended(end, carried_);
}

bool Connections::add(int descriptor, std::size_t most_of_one_address, Use use) {
  std::string peer = peer_name(descriptor);
  const auto cookie = cookie_of(descriptor);
  if (peer.empty() || !cookie) return true;
  auto connection = std::make_shared<Connection>(*this, descriptor, *cookie, peer, use);
  const std::string address = peer_of_address(peer);
  std::unique_lock lock(mutex_);
  if (use != Use::health && !has_room_for(address, most_of_one_address)) {
    lock.unlock();
    if (closed_) closed_(peer, Reason::connections);
    return false;
  }
  if (use == Use::health) {
    make_room_for_health();
    of_health_.push_back(connection);
  }
  const bool is_new = by_peer_.insert_or_assign(std::move(peer), std::move(connection)).second;
  if (is_new && use != Use::health) ++of_address_[address];
  return true;
}

void Connections::make_room_for_health() {
  std::erase_if(of_health_, [](const auto& one) {
    const auto connection = one.lock();
    return connection == nullptr || !connection->is_there();
  });
  if (of_health_.size() < most_of_health) return;
  of_health_.front().lock()->close(Reason::connections);
  of_health_.pop_front();
}

bool Connections::has_room_for(const std::string& address, std::size_t most) {
  const auto found = of_address_.find(address);
  if (found == of_address_.end() || found->second < most) return true;
  forget_gone();
  const auto now = of_address_.find(address);
  return now == of_address_.end() || now->second < most;
}

void Connections::forget_gone() {
  std::erase_if(by_peer_, [this](const auto& entry) {
    if (entry.second->is_there()) return false;
    if (entry.second->use() == Use::health) return true;
    const auto found = of_address_.find(peer_of_address(entry.first));
    if (found != of_address_.end() && --found->second == 0) of_address_.erase(found);
    return true;
  });
}

Connections::Call Connections::begin(std::string_view peer) {
  std::shared_ptr<Connection> connection;
  {
    const std::lock_guard lock(mutex_);
    const auto found = by_peer_.find(std::string(peer));
    if (found == by_peer_.end()) return {};
    connection = found->second;
  }
  connection->call_begins();
  return Call(std::move(connection));
}

bool Connections::look() {
  std::vector<std::shared_ptr<Connection>> here;
  {
    const std::lock_guard lock(mutex_);
    forget_gone();
    here.reserve(by_peer_.size());
    for (const auto& [peer, connection] : by_peer_) here.push_back(connection);
  }
  const Clock::time_point now = Clock::now();
  counts_.begin_round();
  bool has_begun = false;
  for (const auto& connection : here) has_begun = connection->look(now, counts_) || has_begun;
  close_most_streams(here, now);
  close_heaviest(std::move(here));
  give_back_memory(now);
  return has_begun;
}

// An address is a client, or a proxy that opens one connection per client.
void Connections::close_most_streams(std::vector<std::shared_ptr<Connection>> here,
                                     Clock::time_point now) {
  std::erase_if(here, [](const auto& one) { return one->is_shut() || one->alive() == 0; });
  const auto alive = [&here] {
    return std::accumulate(here.begin(), here.end(), std::uint64_t{0},
                           [](auto sum, const auto& one) { return sum + one->alive(); });
  };
  const std::uint64_t most =
      std::max(limits_.unfinished / bytes_of_open_stream, std::uint64_t{2} * limits_.calls);
  if (alive() <= most) return;
  // Many streams may have ended since gRPC was last asked.
  for (const auto& connection : here) connection->look_at_streams(now, counts_);
  std::uint64_t sum = alive();
  std::unordered_map<std::string_view, std::uint64_t> of_addresses;
  for (const auto& connection : here) of_addresses[connection->address()] += connection->alive();
  std::ranges::sort(here, std::greater(), [&](const auto& one) {
    return std::pair(of_addresses[one->address()], one->alive());
  });
  for (const auto& connection : here) {
    if (sum <= most) return;
    sum -= connection->alive();
    connection->close(Reason::calls);
  }
}

// gRPC reads a message of any size before it checks the size; when its buffers are full it ends a
// stream of any client.
void Connections::close_heaviest(std::vector<std::shared_ptr<Connection>> here) {
  std::erase_if(here, [](const auto& connection) { return connection->is_shut(); });
  double sum = 0;
  for (const auto& connection : here) sum += connection->unfinished();
  const auto most = static_cast<double>(limits_.unfinished);
  if (sum <= most) return;
  std::ranges::sort(here, std::greater(), [](const auto& one) { return one->unfinished(); });
  for (const auto& connection : here) {
    if (sum <= most / 2 || connection->unfinished() < least_to_close) return;
    sum -= connection->unfinished();
    connection->close(Reason::unfinished);
  }
}

// gRPC hands calls over more slowly than it reads them, so memory of a flood becomes free much
// later.
void Connections::give_back_memory(Clock::time_point now) {
  if (has_shut_.exchange(false)) gives_back_at_ = now + clearing;
  if (gives_back_at_ == Clock::time_point() || now < gives_back_at_) return;
  gives_back_at_ = {};
  malloc_trim(0);
}

std::size_t Connections::count() const {
  const std::lock_guard lock(mutex_);
  return by_peer_.size();
}

}  // namespace trc::server
