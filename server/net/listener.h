#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "server/net/connections.h"

namespace trc::server {

// A file descriptor that is closed with this object.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool valid() const { return number_ >= 0; }
  int release();

 private:
  int number_ = -1;
};

// A socket that listens at HOST:PORT, [IPV6]:PORT or unix:/path.
class Listener {
 public:
  struct Opened;
  // An address in use is a fault, also where another server answers at the socket file.
  static Opened open(const std::string& address);
  // Takes the socket file away.
  ~Listener();
  Listener(Listener&&) = default;
  Listener& operator=(Listener&&) = default;

  // 0 for a Unix socket.
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] int socket() const { return socket_.number(); }

 private:
  Listener() = default;

  // Of unix:/path.
  static Opened open_path(const std::string& address);
  // Of HOST:PORT.
  static Opened open_port(const std::string& address);

  Descriptor socket_;
  int port_ = 0;
  std::string file_{};
  std::uint64_t file_number_ = 0;  // the inode of its socket
};

struct Listener::Opened {
  std::vector<Listener> listeners{};  // a name may stand for several addresses
  std::string fault{};                // without any: why, one line
};

// Accepts connections and hands them on. gRPC 1.51 can do this itself, but stops for good once the
// process has run out of descriptors (CVE-2023-4785); this thread goes on when there are some
// again. The last descriptors are reserved for the files and sockets of the server itself: a
// connection that would take one of them is closed at once. In between it looks after the open
// connections.
class Acceptor {
 public:
  // Takes the connection over.
  using Take = std::function<void(Descriptor connection)>;

  struct Counts {
    std::uint64_t accepted = 0;
    std::uint64_t refused = 0;  // closed for want of descriptors
  };

  // `connections` watches every connection. `of_one_peer`: how many one address may have open; 0:
  // three quarters of the descriptors, at most 1024.
  Acceptor(Connections& connections, std::uint32_t of_one_peer);
  // Stops accepting.
  ~Acceptor();
  Acceptor(const Acceptor&) = delete;
  Acceptor& operator=(const Acceptor&) = delete;

  using Use = Connections::Use;
  // Before `start`.
  void add(Listener listener, Use use, Take take);
  void start();
  void stop();

  [[nodiscard]] Counts counts() const;
  // Time since the last round of the thread; at most a second as long as it works.
  [[nodiscard]] double seconds_since_last_round() const;

 private:
  struct Door {
    Listener listener;
    int last_usable = 0;  // descriptor
    Take take;
    Use use = Use::work;
  };

  void run();
  // Returns whether they should be looked after again soon.
  bool look_after_connections() noexcept;
  // False when the thread should wait: descriptors or memory are missing.
  bool accept_from(const Door& door);

  Connections& connections_;
  std::vector<Door> doors_;
  Descriptor stop_;
  int last_usable_ = 0;
  std::size_t of_one_peer_;
  std::atomic<std::uint64_t> accepted_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::int64_t> last_round_ns_{0};
  std::thread thread_;
};

}  // namespace trc::server
