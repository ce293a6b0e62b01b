#include "server/net/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "server/net/address.h"
#include "server/resources/round.h"

namespace trc::server {
namespace {

constexpr int backlog = 1024;
// Descriptors that connections leave to the rest of the process, at most an eighth of all.
// Connections to the health port may use half of them.
constexpr int kept_descriptors = 32;
// Each connection may have streams that only ask for health and take a few kilobytes each.
constexpr std::size_t usual_of_one_peer = 1024;
// Nothing limits what arrives between two looks at the connections.
constexpr int round_ms = 50;
constexpr int busy_round_ms = 10;
// The wait for the next attempt when no descriptor is left; the backlog is served then.
constexpr int exhausted_ms = 50;

std::int64_t now_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

std::string refused(const std::string& address, const char* why) {
  return "cannot listen on " + address + ": " + why;
}

std::string refused(const std::string& address, int why) {
  if (why == EADDRINUSE) return refused(address, "the address is in use");
  return refused(address, std::strerror(why));
}

// If somebody answers at a socket file, that is a fault; otherwise the file is left over from a
// server that was killed.
bool somebody_listens_at(const sockaddr_un& address) {
  const Descriptor probe(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  return probe.valid() &&
         connect(probe.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

struct Socket {
  Descriptor descriptor{};
  int why = 0;
};

Socket listening(int family, const sockaddr* address, socklen_t length) {
  Socket result{.descriptor =
                    Descriptor(socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0))};
  const int number = result.descriptor.number();
  const int on = 1;
  if (number >= 0 && family != AF_UNIX) {
    // Allows a restart, and small messages without delay; connections inherit both.
    setsockopt(number, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    setsockopt(number, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    if (family == AF_INET6) setsockopt(number, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof(on));
  }
  if (number < 0 || bind(number, address, length) != 0 || listen(number, backlog) != 0) {
    result.why = errno;
    result.descriptor = Descriptor();
  }
  return result;
}

int port_of(int socket) {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return 0;
  const in_port_t port = address.ss_family == AF_INET6
                             ? reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port
                             : reinterpret_cast<const sockaddr_in*>(&address)->sin_port;
  return ntohs(port);
}

int descriptor_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 1024;
  return static_cast<int>(std::min<rlim_t>(limit.rlim_cur, 1U << 30U));
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    if (valid()) close(number_);
    number_ = other.release();
  }
  return *this;
}

Descriptor::~Descriptor() {
  if (valid()) close(number_);
}

int Descriptor::release() { return std::exchange(number_, -1); }

Listener::Opened Listener::open(const std::string& address) {
  return address.starts_with(unix_prefix) ? open_path(address) : open_port(address);
}

Listener::Opened Listener::open_path(const std::string& address) {
  Opened opened;
  const std::string path = address.substr(unix_prefix.size());
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::memcpy(name.sun_path, path.c_str(), std::min(path.size(), longest_unix_path));
  if (somebody_listens_at(name)) {
    opened.fault = refused(address, "another server answers there");
    return opened;
  }
  struct stat there {};
  if (lstat(path.c_str(), &there) == 0) {
    // A misspelt address must not delete somebody's file.
    if (!S_ISSOCK(there.st_mode)) {
      opened.fault = refused(address, "there is a file which is no socket");
      return opened;
    }
    unlink(path.c_str());
  }
  Socket made = listening(AF_UNIX, reinterpret_cast<const sockaddr*>(&name), sizeof(name));
  if (!made.descriptor.valid()) {
    opened.fault = refused(address, made.why);
    return opened;
  }
  Listener listener;
  listener.socket_ = std::move(made.descriptor);
  listener.file_ = path;
  if (lstat(path.c_str(), &there) == 0) listener.file_number_ = there.st_ino;
  opened.listeners.push_back(std::move(listener));
  return opened;
}

Listener::Opened Listener::open_port(const std::string& address) {
  Opened opened;
  const auto parts = split_host_port(address);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const std::string port = parts ? std::to_string(parts->port) : "";
  const int fault = getaddrinfo(parts ? parts->host.c_str() : "", port.c_str(), &hints, &found);
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, &freeaddrinfo);
  if (fault != 0) {
    opened.fault = refused(address, gai_strerror(fault));
    return opened;
  }
  int why = EADDRNOTAVAIL;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Socket made = listening(one->ai_family, one->ai_addr, one->ai_addrlen);
    if (!made.descriptor.valid()) {
      // A name may have an address of a family that is switched off on this machine. An address in
      // use must not go unnoticed.
      why = made.why;
      if (why == EADDRINUSE) break;
      continue;
    }
    Listener listener;
    listener.socket_ = std::move(made.descriptor);
    listener.port_ = port_of(listener.socket_.number());
    opened.listeners.push_back(std::move(listener));
    // With port 0 each address would get a port of its own.
    if (parts->port == 0) return opened;
  }
  if (why == EADDRINUSE || opened.listeners.empty()) {
    opened.listeners.clear();
    opened.fault = refused(address, why);
  }
  return opened;
}

Listener::~Listener() {
  // If the file was removed, another server may have put its own in its place.
  struct stat there {};
  if (socket_.valid() && !file_.empty() && lstat(file_.c_str(), &there) == 0 &&
      there.st_ino == file_number_)
    unlink(file_.c_str());
}

Acceptor::Acceptor(Connections& connections, std::uint32_t of_one_peer)
    : connections_(connections), stop_(eventfd(0, EFD_CLOEXEC)), of_one_peer_(of_one_peer) {
  const int limit = descriptor_limit();
  last_usable_ = limit - 1 - std::min(kept_descriptors, limit / 8);
  if (of_one_peer_ == 0)
    of_one_peer_ =
        std::min<std::size_t>(static_cast<std::size_t>(limit) / 4 * 3, usual_of_one_peer);
}

Acceptor::~Acceptor() { stop(); }

void Acceptor::add(Listener listener, Use use, Take take) {
  const int more = use == Use::health ? (descriptor_limit() - 1 - last_usable_) / 2 : 0;
  doors_.push_back({.listener = std::move(listener),
                    .last_usable = last_usable_ + more,
                    .take = std::move(take),
                    .use = use});
}

void Acceptor::start() {
  last_round_ns_ = now_ns();
  thread_ = std::thread([this] { run(); });
}

void Acceptor::stop() {
  if (!thread_.joinable()) return;
  eventfd_write(stop_.number(), 1);
  thread_.join();
  doors_.clear();
}

Acceptor::Counts Acceptor::counts() const { return {.accepted = accepted_, .refused = refused_}; }

double Acceptor::seconds_since_last_round() const {
  return static_cast<double>(now_ns() - last_round_ns_) * 1e-9;
}

void Acceptor::run() {
  std::vector<pollfd> waits{{.fd = stop_.number(), .events = POLLIN, .revents = 0}};
  for (const Door& door : doors_)
    waits.push_back({.fd = door.listener.socket(), .events = POLLIN, .revents = 0});
  bool exhausted = false;
  std::int64_t looked_at_ns = now_ns();
  int until_next_ms = round_ms;
  for (;;) {
    last_round_ns_ = now_ns();
    if (last_round_ns_ - looked_at_ns >= until_next_ms * std::int64_t{1'000'000}) {
      until_next_ms = look_after_connections() ? busy_round_ms : round_ms;
      looked_at_ns = now_ns();  // after the look, which takes long at many connections
    }
    // A connection that cannot be accepted would wake this thread at once, so it only waits for the
    // stop.
    const auto watched = exhausted ? 1 : static_cast<nfds_t>(waits.size());
    const int ready = poll(waits.data(), watched, exhausted ? exhausted_ms : until_next_ms);
    if (ready < 0 && errno != EINTR) return;
    if ((waits[0].revents & POLLIN) != 0) return;
    exhausted = false;
    const std::uint64_t accepted_before = accepted_;
    try {
      for (const Door& door : doors_) exhausted = !accept_from(door) || exhausted;
    } catch (const std::bad_alloc&) {
      exhausted = true;  // memory may be free later, as descriptors may
    }
    // A flood begins with its connection.
    if (accepted_ != accepted_before) until_next_ms = busy_round_ms;
  }
}

bool Acceptor::look_after_connections() noexcept {
  bool is_busy = false;
  do_round([&] { is_busy = connections_.look(); });
  return is_busy;
}

bool Acceptor::accept_from(const Door& door) {
  for (;;) {
    Descriptor connection(
        accept4(door.listener.socket(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (connection.valid()) {
      // The system gives the lowest free number, so the number shows how many descriptors are in
      // use.
      if (connection.number() > door.last_usable) {
        ++refused_;
        continue;
      }
      if (!connections_.add(connection.number(), of_one_peer_, door.use)) continue;
      ++accepted_;
      door.take(std::move(connection));
      continue;
    }
    // The peer has gone, or a signal has arrived.
    if (errno == ECONNABORTED || errno == EINTR) continue;
    return errno == EAGAIN;
  }
}

}  // namespace trc::server
