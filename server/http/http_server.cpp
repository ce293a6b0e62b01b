#include "server/http/http_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/strand.hpp>
#include <exception>
#include <limits>
#include <list>
#include <mutex>
#include <new>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "server/http/api.h"
#include "server/http/connection.h"
#include "server/http/memory.h"
#include "server/http/tls.h"
#include "server/resources/round.h"

namespace trc::server::http {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

// Counts connections and finds the one that has waited longest.
struct Waiting {
  void look_at(OpenConnection& connection) {
    ++count;
    const auto waiting = connection.waiting_since();
    if (!waiting || (longest != nullptr && *waiting >= since)) return;
    since = *waiting;
    longest = &connection;
  }

  std::size_t count = 0;
  OpenConnection* longest = nullptr;  // null: all are working
  OpenConnection::Clock::time_point since{};
};

// No limit of its own if one client may have all the memory.
std::size_t memory_of_peer(const Config& config) {
  const bool has_all = config.http_max_memory_per_peer_mib >= config.http_max_memory_mib;
  return has_all ? std::numeric_limits<std::size_t>::max()
                 : std::size_t{config.http_max_memory_per_peer_mib} << 20U;
}

// These threads only move bytes; workers compute.
constexpr unsigned thread_count = 2;

std::string peer_of(const Tcp::socket& socket) {
  boost::system::error_code fault;
  const auto peer = socket.remote_endpoint(fault);
  if (fault) return {};
  std::ostringstream text;
  text << peer;
  return text.str();
}

}  // namespace

struct HttpServer::Parts {
  Parts(Backend& given, Options options)
      : backend(given),
        memory(std::size_t{given.config.http_max_memory_mib} << 20U),
        of_peers(memory_of_peer(given.config)),
        api(given, options.channel, memory,
            {.local = options.local,
             .tls = options.certificates != nullptr,
             .offer = std::move(options.offer)}),
        limits{.timeout = std::chrono::seconds(given.config.http_timeout_s)} {
    if (options.certificates) tls = std::make_unique<Tls>(options.certificates);
    for (unsigned i = 0; i < thread_count; ++i) threads.emplace_back([this] { run(); });
  }

  // A connection that fails or finds no memory is dropped; the others stay.
  void run() {
    while (!io.stopped()) do_round([this] { serve_until_one_fails(); });
  }
  void serve_until_one_fails();
  // Makes room for a connection of this client by closing the one that has waited longest for a
  // request, one of the client's own if the client has all it may have. False when all are working.
  bool make_room(const std::string& client, const std::string& peer);
  [[nodiscard]] bool any_works();

  Backend& backend;
  Memory memory;
  MemoryOfPeers of_peers;
  Api api;
  const ConnectionLimits limits;
  std::unique_ptr<Tls> tls;
  asio::io_context io{static_cast<int>(thread_count)};
  asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
  std::mutex mutex;
  struct Known {
    std::weak_ptr<OpenConnection> connection;
    std::string client;
  };
  std::list<Known> connections;
  std::vector<std::thread> threads;
};

// An exception of a handler must not end the process, which also serves gRPC streams.
void HttpServer::Parts::serve_until_one_fails() {
  try {
    io.run();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& bug) {
    backend.telemetry.log.error(LogLine("incident").text("what", bug.what()));
  }
}

bool HttpServer::Parts::make_room(const std::string& client, const std::string& peer) {
  // These pointers are released after the mutex: closing a connection takes time. A connection that
  // ends does not call back here.
  std::vector<std::shared_ptr<OpenConnection>> alive;
  const std::lock_guard lock(mutex);
  Waiting of_all;
  Waiting own;
  for (auto one = connections.begin(); one != connections.end();) {
    alive.push_back(one->connection.lock());
    if (alive.back() == nullptr) {
      one = connections.erase(one);
      continue;
    }
    of_all.look_at(*alive.back());
    if (one->client == client) own.look_at(*alive.back());
    ++one;
  }
  const bool has_its_share = own.count >= backend.config.http_max_connections_per_peer;
  if (!has_its_share && of_all.count < backend.config.http_max_connections) return true;
  OpenConnection* const longest = has_its_share ? own.longest : of_all.longest;
  if (longest == nullptr) {
    const char* const reason = has_its_share ? "http_connections_of_peer" : "http_connections";
    backend.telemetry.metrics.count_connection_closed(reason);
    backend.telemetry.log.warning(
        LogLine("connection_closed").text("peer", peer).text("reason", reason));
    return false;
  }
  longest->close();
  connections.remove_if([&](const Known& one) { return one.connection.lock().get() == longest; });
  return true;
}

bool HttpServer::Parts::any_works() {
  std::vector<std::shared_ptr<OpenConnection>> alive;
  const std::lock_guard lock(mutex);
  for (const auto& one : connections) {
    alive.push_back(one.connection.lock());
    if (alive.back() != nullptr && !alive.back()->waiting_since()) return true;
  }
  return false;
}

HttpServer::HttpServer(Backend& backend, Options options)
    : parts_(std::make_unique<Parts>(backend, std::move(options))) {}

HttpServer::~HttpServer() {
  {
    std::vector<std::shared_ptr<OpenConnection>> alive;
    const std::lock_guard lock(parts_->mutex);
    for (const auto& one : parts_->connections) {
      alive.push_back(one.connection.lock());
      if (alive.back() != nullptr) alive.back()->close();
    }
  }
  // The computations of these connections end; nobody waits for them any more.
  parts_->api.stop();
  parts_->work.reset();
  parts_->io.stop();
  for (std::thread& thread : parts_->threads) thread.join();
}

void HttpServer::take(Descriptor connection) {
  Parts& parts = *parts_;
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (::getsockname(connection.number(), reinterpret_cast<sockaddr*>(&address), &length) != 0)
    return;
  const int on = 1;
  ::setsockopt(connection.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  // Otherwise the system keeps megabytes of an answer that nobody reads.
  const int send_buffer = 256 << 10;
  ::setsockopt(connection.number(), SOL_SOCKET, SO_SNDBUF, &send_buffer, sizeof send_buffer);
  Tcp::socket socket(asio::make_strand(parts.io));
  boost::system::error_code fault;
  socket.assign(address.ss_family == AF_INET6 ? Tcp::v6() : Tcp::v4(), connection.number(), fault);
  if (fault) return;
  connection.release();
  NewConnection given{.socket = std::move(socket),
                      .allowed_clients = parts.backend.config.tls_allowed_clients};
  given.peer = peer_of(given.socket);
  const std::string client = client_of(given.peer);
  if (!parts.make_room(client, given.peer)) return;
  given.of_peer = parts.of_peers.of(client);
  if (parts.tls) {
    given.tls = parts.tls->context();
    if (given.tls == nullptr) return;
  }
  const auto served = serve(std::move(given), parts.api, parts.memory, parts.limits);
  const std::lock_guard lock(parts.mutex);
  parts.connections.push_back({.connection = served, .client = client});
}

bool HttpServer::wait_until_idle(std::chrono::steady_clock::time_point deadline) {
  constexpr std::chrono::milliseconds pause{10};
  while (parts_->any_works()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

}  // namespace trc::server::http
