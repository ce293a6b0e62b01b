#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "client/trc/connection.h"
#include "client/trc/failure.h"
#include "core/messages/diagnostic_text.h"  // for who reads the diagnostics in the answers
#include "core/session/answers.h"
#include "proto/wire/block.h"
#include "proto/wire/path_item.h"
#include "proto/wire/setup.h"

namespace trc::client {

// A path compensated by a server. It is fed with items, where trc::PathSession is given them
// through program(). Used by one thread at a time.
class RemotePathSession {
 public:
  // Requests use the layout of the responses.
  RemotePathSession(const Connection& connection, const wire::PathSettings& settings);
  // The setup as a message, for callers that hold one.
  RemotePathSession(const Connection& connection, const v1::PathSetup& setup);
  // Cancels a stream that has not finished.
  ~RemotePathSession();
  RemotePathSession(const RemotePathSession&) = delete;
  RemotePathSession& operator=(const RemotePathSession&) = delete;

  // Sends the items, divided into batches the server takes, and appends what
  // has become certain. `Source::index` is ignored: position counts. A MoveRequest
  // must be absolute. Returns false once the stream has ended; `failure` then
  // says why.
  bool feed(std::span<const wire::PathInput> items, Answers& out);
  // End of the path: appends all that was held back. Returns whether the path
  // was compensated completely.
  bool finish(Answers& out);

  [[nodiscard]] const std::optional<Failure>& failure() const;
  // How often the stream was lost and another one has gone on.
  [[nodiscard]] std::uint64_t resumed() const;
  // Of a complete run only.
  [[nodiscard]] const std::optional<wire::PathSummary>& summary() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trc::client
