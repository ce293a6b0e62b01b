#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "server/http/exchange.h"
#include "server/http/memory.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// The requests of connections to their server.
class Service {
 public:
  struct Admission {
    std::size_t most_body_bytes = 0;
    std::optional<v1::Problem> refused{};
  };

  virtual ~Service() = default;
  // Decides by the head of a request, before its body is read.
  [[nodiscard]] virtual Admission admit(const Request& head) = 0;
  // Frees something that is only kept for later; false: there is nothing of the kind.
  virtual bool make_room() = 0;
  virtual void handle(const ExchangePointer& exchange) = 0;
  // Headers every answer has.
  virtual void decorate(const Request& request, Head& head) = 0;
  enum class End : std::uint8_t { whole, broken_off };
  virtual void log(const Request& request, unsigned status, std::uint64_t bytes, double ms,
                   End end) = 0;
};

// A connection as the server sees it from outside. From any thread.
class OpenConnection {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~OpenConnection() = default;
  virtual void close() = 0;
  // Since when it waits for the head of a request; none while a request is in progress.
  [[nodiscard]] std::optional<Clock::time_point> waiting_since() const {
    const Clock::rep since = waiting_since_;
    if (since == 0) return std::nullopt;
    return Clock::time_point(Clock::duration(since));
  }

 protected:
  void waits() { waiting_since_ = Clock::now().time_since_epoch().count(); }
  void works() { waiting_since_ = 0; }

 private:
  std::atomic<Clock::rep> waiting_since_{Clock::now().time_since_epoch().count()};
};

// What all connections of a server share.
struct ConnectionLimits {
  // For a head, for each piece of a body, and for each piece of an answer.
  std::chrono::seconds timeout{20};
  std::size_t most_header_bytes = 16U << 10U;
};

}  // namespace trc::server::http
