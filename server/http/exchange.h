#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/telemetry/trace.h"

namespace trc::server::http {

// Names and values in the order they came or go.
using Pairs = std::vector<std::pair<std::string, std::string>>;

// What a client asks, read as a whole.
struct Request {
  std::string method;
  std::string path;  // decoded, without the query
  Pairs query{};     // decoded
  Pairs headers{};   // names in lower case
  std::string body{};
  std::string peer;
  Trace trace{};  // RPCs made of it are part of; empty before it is handled

  // Empty when there is none.
  [[nodiscard]] std::string_view header(std::string_view name) const;
  // Sets a header, replacing the one it has.
  void set_header(std::string_view name, std::string value);
  // Whether the Accept header names this type itself, and does not refuse it (q=0).
  [[nodiscard]] bool accepts(std::string_view type) const;
  // The Content-Type without parameters, in lower case.
  [[nodiscard]] std::string content_type() const;
  // The charset parameter of the Content-Type, in lower case; empty when there is none.
  [[nodiscard]] std::string charset() const;
  // Moves the body out, to be shared by all who need it.
  [[nodiscard]] std::shared_ptr<const std::string> take_body();
};

// The name of the client whose limits requests from "192.0.2.7:40000" or "[2001:db8::1]:40000"
// count to, as peer_of_address().
[[nodiscard]] std::string client_of(const std::string& peer);

// NC text, whatever its type is called; but not that of a form, in which a program loses its lines.
[[nodiscard]] bool is_text(std::string_view content_type);
// JSON, also under the name that `curl -d` gives to any data. A form of a foreign page sends its
// origin, and is refused for that.
[[nodiscard]] bool is_json(std::string_view content_type);

// The head of an answer.
struct Head {
  unsigned status = 200;
  std::string content_type{};
  Pairs headers{};
};

// One request and the way its answer takes. Everything is called in the executor of its connection,
// one call at a time; `post` is the way into it. An exchange that is destroyed without an answer
// breaks its connection off.
class Exchange {
 public:
  // Whether the client still accepts output.
  using Written = std::function<void(bool taken)>;

  virtual ~Exchange() = default;
  [[nodiscard]] virtual Request& request() = 0;

  // The whole answer.
  virtual void answer(Head head, std::string body) = 0;

  // An answer of unknown length: begin, any number of writes, each after `then` of the one before,
  // and end. Trailers must be named in the head.
  virtual void begin(Head head) = 0;
  virtual void write(std::string piece, Written then) = 0;
  virtual void end(const Pairs& trailers) = 0;
  // Closes the connection without the end of the answer, so that no client takes it for complete.
  virtual void break_off() = 0;

  // Called once when the client has gone before it has its answer.
  virtual void when_gone(std::function<void()> then) = 0;
  // Runs in the executor of the connection. From any thread.
  virtual void post(std::function<void()> then) = 0;

  // Asks for memory that is held until the exchange ends. False when there is none.
  [[nodiscard]] virtual bool hold(std::size_t bytes) = 0;
};
using ExchangePointer = std::shared_ptr<Exchange>;

}  // namespace trc::server::http
