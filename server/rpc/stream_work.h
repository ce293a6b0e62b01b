#pragma once

#include <utility>

#include "server/rpc/status.h"

namespace trc::server {

// The request of a turn: whether an answer is to be written, and the next step.
struct Turn {
  enum class Next {
    proceed,  // another turn without new input: more answers are waiting
    read,     // the next request
    finish,   // the end of the RPC
  };
  bool write = false;
  Next next = Next::read;
  Ending ending{};  // with Next::finish
};

// The RPC ends without a further answer.
inline Turn end(Ending ending) {
  return {.write = false, .next = Turn::Next::finish, .ending = std::move(ending)};
}

// The protocol of one stream without gRPC: requests in, answers out, one turn at a time. A turn
// computes; it is called from a worker thread, or from the reaction where `is_short` says so. Turns
// of one stream never overlap.
template <class Request, class Response>
class StreamWork {
 public:
  virtual ~StreamWork() = default;
  // A request has arrived.
  virtual Turn take(const Request& request, Response& response) = 0;
  // After Next::proceed, once the answer was written.
  virtual Turn proceed(Response& response) = 0;
  // The client sends nothing more.
  virtual Turn ended(Response& response) = 0;

  // Whether the next turn takes no longer than handing it to a worker would. `request` is what it
  // would take; null: nothing new.
  [[nodiscard]] virtual bool is_short(const Request* /*request*/) const { return false; }
};

}  // namespace trc::server
