#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/messages/sentences.h"
#include "proto/wire/field_fault.h"
#include "proto/wire/unknown_fields.h"

namespace trc::server {

// Why the server ends a call, apart from a fault in the program, which is a Diagnostic.
enum class Refusal {
  setup_missing,
  setup_repeated,
  request_empty,
  input_after_final,
  batch_out_of_sequence,
  text_out_of_sequence,
  contour_incomplete,
  stream_idle,
  field_invalid,
  field_unknown,
  message_too_large,
  batch_too_large,
  request_unreadable,
  json_unreadable,
  call_invalid,
  stream_needs_grpc,
  rpc_unknown,
  answer_too_large,
  stream_limit,
  stream_limit_of_peer,
  memory_limit,
  memory_limit_of_peer,
  memory_limit_of_stream,
  memory_limit_of_process,
  cpu_limit,
  resume_token_invalid,
  resume_token_of_other_version,
  resume_setup_differs,
  client_not_allowed,
  draining,
  drain_timeout,
  cancelled,
  deadline_exceeded,
  internal,
};

// How a call ended; OK unless said otherwise.
struct Ending {
  grpc::Status status;
  std::string reason;  // UPPER_SNAKE, for log and metrics; empty when OK
};

// The parts of a message that change from case to case; they also go into ErrorInfo.metadata.
using Values = std::vector<std::pair<std::string, std::string>>;

// The status of a refusal with ErrorInfo and, where waiting helps, RetryInfo. `detail` completes
// the sentence of the table. Where a value `field` says which part of a request is invalid,
// BadRequest names it as well.
[[nodiscard]] Ending refuse(Refusal refusal, std::string_view detail = {},
                            const Values& values = {});

// The status of a batch of `got` blocks where `most` are taken.
[[nodiscard]] Ending refuse_batch_of(std::string_view got, std::uint32_t most);

// The status of a message with fields that cannot be taken: BadRequest names them, at most
// FieldFaults::most_listed; how many more there were is said.
[[nodiscard]] Ending refuse(const wire::FieldFaults& faults);

// The status of a request with a field that this build does not have.
[[nodiscard]] Ending refuse(const wire::UnknownField& unknown);

// The status of a program that cannot be compensated: INVALID_ARGUMENT with the reason of the
// code's row, place, values and remedy; RESOURCE_EXHAUSTED where a limit was passed.
[[nodiscard]] Ending refuse(const Diagnostic& diagnostic);

// The German of the sentences of refusals, alone and with a detail after them.
[[nodiscard]] std::span<const Sentence> refusal_sentences();

// "INVALID_ARGUMENT" and so on.
[[nodiscard]] std::string_view name_of(grpc::StatusCode code);

}  // namespace trc::server
