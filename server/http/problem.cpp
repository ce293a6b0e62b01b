#include "server/http/problem.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/language.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/json.h"
#include "server/http/german.h"
#include "server/rpc/status.h"
#include "server/text.h"

namespace trc::server::http {
namespace {

using grpc::StatusCode;

constexpr std::size_t longest_detail = 1000;

// What a gRPC code means here.
struct Meaning {
  unsigned status;
  std::string_view title;
};

Meaning meaning_of(StatusCode code) {
  switch (code) {
    case StatusCode::INVALID_ARGUMENT:
      return {400, "The request has a value that cannot be taken"};
    case StatusCode::FAILED_PRECONDITION:
      return {400, "The request cannot be taken as it is"};
    case StatusCode::OUT_OF_RANGE:
      return {400, "The request is out of sequence"};
    case StatusCode::ABORTED:
      return {408, "The request was not complete in time"};
    case StatusCode::PERMISSION_DENIED:
      return {403, "This client is not allowed"};
    case StatusCode::UNAUTHENTICATED:
      return {401, "This client is not known"};
    case StatusCode::NOT_FOUND:
      return {404, "There is no such thing"};
    case StatusCode::UNIMPLEMENTED:
      return {404, "There is no such method"};
    case StatusCode::RESOURCE_EXHAUSTED:
      return {503, "A limit of the server is reached"};
    case StatusCode::UNAVAILABLE:
      return {503, "The server takes no work at the moment"};
    case StatusCode::DEADLINE_EXCEEDED:
      return {504, "The work was not done in time"};
    default:
      return {500, "The server has failed"};
  }
}

template <class Detail>
void for_each(const google::rpc::Status& status, const std::function<void(const Detail&)>& take) {
  for (const auto& any : status.details()) {
    Detail detail;
    if (any.UnpackTo(&detail)) take(detail);
  }
}

void set_reason(v1::Problem& problem, std::string_view reason) {
  problem.set_reason(std::string(reason));
  problem.set_type("urn:trc:" + std::string(reason));
}

// Limits that a smaller request would keep; waiting does not help. Limits of the machine are not
// among them: WEAR_TOO_LARGE, INSIDE_CORNER_ANGLE_TOO_LARGE.
bool is_about_size(std::string_view reason) {
  constexpr std::array sizes{"ANSWER_TOO_LARGE", "BATCH_TOO_LARGE", "COMPUTING_TEXT_TOO_LONG",
                             "NC_LINE_TOO_LONG", "SELECTION_TOO_LONG"};
  return std::find(sizes.begin(), sizes.end(), reason) != sizes.end();
}

// A limit that this request exceeds at any time.
bool is_beyond_a_limit(const grpc::Status& status, const google::rpc::Status& rich) {
  bool may_come_again = false;
  for_each<google::rpc::RetryInfo>(rich, [&](const auto&) { may_come_again = true; });
  return status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED && !may_come_again;
}

}  // namespace

v1::Problem problem_of(const grpc::Status& status) {
  const Meaning meaning = meaning_of(status.error_code());
  v1::Problem problem;
  problem.set_status(meaning.status);
  problem.set_title(std::string(meaning.title));
  problem.set_detail(presentable(status.error_message(), longest_detail));
  set_reason(problem, name_of(status.error_code()));
  google::rpc::Status rich;
  if (!rich.ParseFromString(status.error_details())) return problem;
  for_each<google::rpc::ErrorInfo>(rich, [&](const auto& info) {
    set_reason(problem, info.reason());
    const bool of_program = info.metadata().contains("code");
    if (of_program && problem.status() == 400) {
      problem.set_status(422);
      problem.set_title("The program cannot be compensated");
    }
    const bool is_too_large = !of_program && is_about_size(info.reason());
    if (is_too_large || is_beyond_a_limit(status, rich)) problem.set_status(413);
    // A path is always one batch.
    if (info.reason() == "BATCH_TOO_LARGE")
      problem.set_detail("it has " + info.metadata().at("got") + " blocks, at most " +
                         info.metadata().at("max_blocks_per_batch") +
                         " are taken (max-blocks-per-batch); divide the path, send it as an NC "
                         "program, or stream it with gRPC");
  });
  for_each<google::rpc::LocalizedMessage>(rich, [&](const auto& localized) {
    problem.set_detail(presentable(localized.message(), longest_detail));
    if (problem.status() == 422 && language_of_tag(localized.locale()) == Language::german)
      problem.set_title("Das Programm kann nicht korrigiert werden");
  });
  for_each<google::rpc::BadRequest>(rich, [&](const auto& request) {
    for (const auto& violation : request.field_violations()) {
      v1::FieldProblem& field = *problem.add_fields();
      field.set_field(violation.field());
      field.set_description(violation.description());
    }
  });
  return problem;
}

v1::Problem problem(unsigned status, std::string_view reason, std::string_view title,
                    std::string_view detail) {
  v1::Problem problem;
  problem.set_status(status);
  set_reason(problem, reason);
  problem.set_title(std::string(title));
  problem.set_detail(presentable(detail));
  return problem;
}

void answer_problem(Exchange& exchange, v1::Problem problem, const Pairs& headers) {
  if (accepted_language(exchange.request().header("accept-language")) == Language::german)
    make_german(problem);
  Head head{
      .status = problem.status(), .content_type = "application/problem+json", .headers = headers};
  if (problem.status() == 503) head.headers.emplace_back("Retry-After", "1");
  exchange.answer(std::move(head), wire::json_of(problem) + "\n");
}

}  // namespace trc::server::http
