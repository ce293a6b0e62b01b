#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "proto/wire/compensated_batch_bytes.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/setup.h"
#include "server/backend.h"
#include "server/rpc/arena_message.h"
#include "server/rpc/outbox.h"
#include "server/rpc/stream_work.h"
#include "server/telemetry/call_record.h"

namespace trc::server {

// Writes blocks and diagnostics of a slice into a response of any RPC. The message of the columns
// is reused from one response to the next. Blocks as messages are inserted as their encoded bytes:
// Protobuf takes them for an unknown field, which it sends as it is.
template <class Response>
void write_slice(const Outbox::Slice& slice, wire::Layout layout, Response& response) {
  ready_bytes_of(response).Clear();
  if (slice.blocks.empty()) {
    response.clear_response();
  } else if (layout == wire::Layout::columns) {
    wire::to_proto(slice.blocks, slice.first_block, *response.mutable_columns());
  } else {
    response.clear_response();
    wire::append_batch(slice.blocks, slice.first_block,
                       *ready_bytes_of(response).AddLengthDelimited(Response::kBatchFieldNumber));
  }
  response.clear_diagnostics();
  for (const Diagnostic& diagnostic : slice.diagnostics)
    wire::to_proto(diagnostic, *response.add_diagnostics());
}

// The responses to one request: everything that is certain, in its order, then its end. An error
// becomes the status, after all that was certain before it; a finished path ends with the summary.
class Responses {
 public:
  Responses(Backend& backend, CallRecord& record) : backend_(backend), record_(record) {}

  [[nodiscard]] Outbox& outbox() { return outbox_; }
  [[nodiscard]] const Outbox& outbox() const { return outbox_; }

  // A request has arrived; it gets at least one answer, unless the RPC ends.
  void begin() { answered_ = false; }
  // The session has been stopped: the first of its errors ends the RPC.
  void end_with_error();
  // The RPC ends with this error once the outbox is empty. The first one counts.
  void end_with(Ending error) {
    if (!error_) error_ = std::move(error);
  }
  // The summary comes once the outbox is empty.
  void finish() { summary_due_ = true; }
  // Whether input of the request is still to be taken, once the outbox is empty. The certain part
  // of the answer to a large request leaves before the rest of the request is taken.
  void input_is_left(bool left) {
    // The last answer to a request says that all of it was taken.
    if (input_left_ && !left) answered_ = false;
    input_left_ = left;
  }

  [[nodiscard]] bool failed() const { return error_.has_value(); }
  // Whether an error of the session has ended the RPC.
  [[nodiscard]] bool is_refused() const { return refused_; }

  // The next answer. `finish_slice(slice, last)` adds what is particular to the RPC; `last` says
  // that nothing of this request follows but the summary, which `summarize` fills in.
  template <class Response, class FinishSlice, class Summarize>
  Turn next(wire::Layout layout, Response& response, FinishSlice finish_slice,
            Summarize summarize) {
    if (!outbox_.empty() || (!answered_ && !error_)) {
      answered_ = true;
      const Outbox::Slice slice = outbox_.take(
          layout, std::min<std::size_t>(most_answer_bytes, backend_.config.max_message_bytes));
      write_slice(slice, layout, response);
      finish_slice(slice, outbox_.empty() && !input_left_);
      record_.sent(slice.blocks.size());
      outbox_.forget_taken();
      const bool more = !outbox_.empty() || input_left_ || error_ || summary_due_;
      return {.write = true, .next = more ? Turn::Next::proceed : Turn::Next::read, .ending = {}};
    }
    if (error_) return end(*error_);
    summary_due_ = false;
    response.Clear();
    summarize();
    record_.sent(0);
    return {.write = true, .next = Turn::Next::read, .ending = {}};
  }

 private:
  // An answer stays in gRPC's buffers until the client reads it, and hundreds of clients that do
  // not read must not add up to much. The output of 1024 blocks fits; every further answer would
  // take the stream through gRPC's threads and back once more.
  static constexpr std::size_t most_answer_bytes = 192U << 10U;

  Backend& backend_;
  CallRecord& record_;
  Outbox outbox_;
  std::optional<Ending> error_;
  bool refused_ = false;
  bool summary_due_ = false;
  bool answered_ = false;
  bool input_left_ = false;
};

}  // namespace trc::server
