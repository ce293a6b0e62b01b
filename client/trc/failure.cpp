#include "client/trc/failure.h"

#include <grpcpp/support/status.h>

#include <array>
#include <cstddef>
#include <utility>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace trc::client {
namespace {

std::string name_of(grpc::StatusCode code) {
  constexpr std::array<const char*, 17> names{"OK",
                                              "CANCELLED",
                                              "UNKNOWN",
                                              "INVALID_ARGUMENT",
                                              "DEADLINE_EXCEEDED",
                                              "NOT_FOUND",
                                              "ALREADY_EXISTS",
                                              "PERMISSION_DENIED",
                                              "RESOURCE_EXHAUSTED",
                                              "FAILED_PRECONDITION",
                                              "ABORTED",
                                              "OUT_OF_RANGE",
                                              "UNIMPLEMENTED",
                                              "INTERNAL",
                                              "UNAVAILABLE",
                                              "DATA_LOSS",
                                              "UNAUTHENTICATED"};
  const auto index = static_cast<std::size_t>(code);
  return index < names.size() ? names[index] : "UNKNOWN";
}

void read_detail(const google::protobuf::Any& detail, Failure& failure) {
  google::rpc::ErrorInfo error;
  google::rpc::BadRequest request;
  google::rpc::RetryInfo retry;
  if (detail.UnpackTo(&error)) {
    failure.reason = error.reason();
    for (const auto& [name, value] : error.metadata()) failure.values[name] = value;
  } else if (detail.UnpackTo(&request)) {
    for (const auto& violation : request.field_violations())
      failure.fields.push_back(
          {.field = violation.field(), .description = violation.description()});
  } else if (detail.UnpackTo(&retry)) {
    failure.retry_after_seconds =
        static_cast<double>(retry.retry_delay().seconds()) + 1e-9 * retry.retry_delay().nanos();
  }
}

}  // namespace

bool Failure::unreachable() const {
  return is_crowded_out() || not_taken_over() || status == "UNAVAILABLE" || status == "INTERNAL" ||
         status == "UNKNOWN" || status == "DEADLINE_EXCEEDED" || status == "CANCELLED" ||
         status == "UNAUTHENTICATED" || status == "PERMISSION_DENIED";
}

bool Failure::not_taken_over() const {
  return reason == "RESUME_TOKEN_INVALID" || reason == "RESUME_TOKEN_OF_OTHER_VERSION";
}

// gRPC itself sends this status when its buffers are full, to an arbitrary stream. A limit of the
// server has a reason, and a message that is too large will be so again.
bool Failure::is_crowded_out() const {
  return status == "RESOURCE_EXHAUSTED" && reason.empty() &&
         message.find("larger than max") == std::string::npos;
}

// Balancers report a server that died as CANCELLED or INTERNAL, and gRPC reports some resets as
// UNKNOWN. A status of the server itself has a reason.
bool Failure::stream_lost() const {
  if (status == "UNAVAILABLE" || reason == "STREAM_IDLE" || is_crowded_out()) return true;
  return reason.empty() && (status == "CANCELLED" || status == "INTERNAL" || status == "UNKNOWN");
}

bool Failure::not_taken() const {
  return status == "UNAVAILABLE" || (status == "CANCELLED" && reason.empty()) || is_crowded_out();
}

std::optional<Failure> failure_of(const grpc::Status& status) {
  if (status.ok()) return std::nullopt;
  Failure failure{.status = name_of(status.error_code()), .message = status.error_message()};
  google::rpc::Status details;
  // Code and message remain valid if the details cannot be read.
  if (!details.ParseFromString(status.error_details())) return failure;
  for (const google::protobuf::Any& detail : details.details()) read_detail(detail, failure);
  // A balancer may reset the stream after the server's status, and gRPC then reports the reset.
  if (details.code() != 0) {
    failure.status = name_of(static_cast<grpc::StatusCode>(details.code()));
    failure.message = details.message();
  }
  return failure;
}

Failure invalid_response(const wire::FieldFaults& faults) {
  Failure failure{.status = "INTERNAL",
                  .message = "the server's response does not hold together",
                  .reason = "RESPONSE_INVALID",
                  .fields = faults.listed()};
  if (!failure.fields.empty())
    failure.message += ": " + failure.fields[0].field + " " + failure.fields[0].description;
  return failure;
}

Failure resumed_path_differs() {
  return {.status = "INTERNAL",
          .message = "the stream was resumed, but the server gave another path than before",
          .reason = "RESUMED_PATH_DIFFERS"};
}

Failure missing_summary() {
  return {.status = "INTERNAL",
          .message = "the server ended the stream without a summary, the path may be incomplete",
          .reason = "SUMMARY_MISSING"};
}

}  // namespace trc::client
