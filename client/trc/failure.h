#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "proto/wire/field_fault.h"

namespace grpc {
class Status;
}

namespace trc::client {

// Why a call did not end with OK.
struct Failure {
  std::string status{};                         // the name of the gRPC code, "UNAVAILABLE"
  std::string message{};                        // one sentence for people
  std::string reason{};                         // UPPER_SNAKE, stable; empty: the server gave none
  std::map<std::string, std::string> values{};  // the parts of the message that vary
  std::vector<wire::FieldFault> fields{};       // of the request, at most 20
  std::optional<double> retry_after_seconds{};  // absent: retrying does not help by itself

  // The server could not be reached, went away, broke or forgot: nothing was wrong with
  // the request.
  [[nodiscard]] bool unreachable() const;
  // The stream was lost, and the server that is there now cannot take it over: it has another key
  // for its tokens, as one that was started anew, or another version. Tokens come from servers
  // alone.
  [[nodiscard]] bool not_taken_over() const;
  // The stream was lost, or the server gave it up, and another one may take it
  // over: nothing says that the input or the server has a fault.
  [[nodiscard]] bool stream_lost() const;
  // Of a stream that no server has accepted: the one it was given to died or stops, another one may
  // take it.
  [[nodiscard]] bool not_taken() const;
  // A place, or memory, is missing there for a moment.
  [[nodiscard]] bool asks_to_wait() const {
    return retry_after_seconds.has_value() && reason != "INTERNAL";
  }

 private:
  // Ended for want of buffers, not for what it had sent.
  [[nodiscard]] bool is_crowded_out() const;
};

// Nothing when the status is OK.
[[nodiscard]] std::optional<Failure> failure_of(const grpc::Status& status);
// A response that no server of this version sends.
[[nodiscard]] Failure invalid_response(const wire::FieldFaults& faults);
// What a resumed stream gave again is not what the first one gave: its servers differ.
[[nodiscard]] Failure resumed_path_differs();
// The server said OK without a summary: the path may be half of one.
[[nodiscard]] Failure missing_summary();

}  // namespace trc::client
