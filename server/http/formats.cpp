#include "server/http/formats.h"

#include "proto/wire/json.h"
#include "server/http/problem.h"
#include "server/text.h"

namespace trc::server::http {
namespace {

const v1::PathSummary& path_of(const v1::PathSummary& summary) { return summary; }
const v1::PathSummary& path_of(const v1::ProgramSummary& summary) { return summary.path(); }

}  // namespace

void ProblemFormat::refuse(const ExchangePointer& exchange, const grpc::Status& status) {
  v1::Problem problem = problem_of(status);
  for (const v1::Diagnostic& diagnostic : diagnostics_) *problem.add_diagnostics() = diagnostic;
  answer_problem(*exchange, problem);
}

bool ProblemFormat::stop(const grpc::Status& /*status*/, std::string& /*out*/) { return false; }

Pairs ProblemFormat::warnings() const {
  Pairs headers{{"Trc-Warnings", std::to_string(warnings_)}};
  const auto first =
      std::ranges::find(diagnostics_, v1::Diagnostic::WARNING, &v1::Diagnostic::severity);
  if (first == diagnostics_.end()) return headers;
  std::string& value =
      headers.emplace_back("Trc-First-Warning", std::to_string(first->code())).second;
  if (first->has_line()) value.append("; line=").append(std::to_string(first->line()));
  return headers;
}

bool NcTextFormat::take(const grpc::ByteBuffer& answer, std::string& out) {
  if (!RpcCall::read_message(answer, answer_)) return false;
  remember(answer_.diagnostics());
  out += answer_.nc_text();
  return true;
}

bool NcTextFormat::stop(const grpc::Status& status, std::string& out) {
  if (!out.empty() && out.back() != '\n') out += '\n';
  out += "!!! TRC STOPPED, THIS PROGRAM IS NOT COMPLETE: " + presentable(status.error_message()) +
         " !!!\n";
  return false;
}

template <class Response>
bool JsonLinesFormat<Response>::take(const grpc::ByteBuffer& answer, std::string& out) {
  if (!RpcCall::read_message(answer, answer_)) return false;
  this->remember(answer_.diagnostics());
  if (answer_.response_case() == Response::kBatch) {
    for (auto& block : *answer_.mutable_batch()->mutable_blocks()) {
      item_.mutable_block()->Swap(&block);
      lines_.append(item_, out);
    }
  }
  for (auto& diagnostic : *answer_.mutable_diagnostics()) {
    item_.mutable_diagnostic()->Swap(&diagnostic);
    lines_.append(item_, out);
  }
  if (answer_.response_case() == Response::kSummary) {
    *item_.mutable_summary() = path_of(answer_.summary());
    lines_.append(item_, out);
  }
  return true;
}

template <class Response>
bool JsonLinesFormat<Response>::stop(const grpc::Status& status, std::string& out) {
  const v1::Problem problem = problem_of(status);
  constexpr unsigned of_program = 422;
  if (problem.status() != of_program) out += "{\"problem\":" + wire::json_of(problem) + "}\n";
  return false;
}

template <class Response>
bool PathAnswerFormat<Response>::take(const grpc::ByteBuffer& answer, std::string& /*out*/) {
  if (!RpcCall::read_message(answer, answer_)) return false;
  this->remember(answer_.diagnostics());
  whole_.mutable_diagnostics()->MergeFrom(answer_.diagnostics());
  if (answer_.response_case() == Response::kSummary)
    *whole_.mutable_summary() = path_of(answer_.summary());
  if (blocks_ == Blocks::left_out) return true;
  bytes_ += answer.Length();
  if (answer_.response_case() == Response::kBatch)
    whole_.mutable_blocks()->MergeFrom(answer_.batch().blocks());
  return bytes_ <= most_bytes_;
}

template <class Response>
void PathAnswerFormat<Response>::close(std::string& out) {
  wire::Json().append(whole_, out);
  out += '\n';
}

bool RecordFormat::take(const grpc::ByteBuffer& answer, std::string& /*out*/) {
  if (!RpcCall::read_message(answer, answer_)) return false;
  remember(answer_.diagnostics());
  if (!answer_.record().empty()) record_ = answer_.record();
  return true;
}

void RecordFormat::close(std::string& out) { out += record_ + '\n'; }

bool SurveyFormat::take(const grpc::ByteBuffer& answer, std::string& /*out*/) {
  if (!RpcCall::read_message(answer, answer_)) return false;
  remember(answer_.diagnostics());
  whole_.mutable_diagnostics()->MergeFrom(answer_.diagnostics());
  if (answer_.has_radius()) *whole_.add_radii() = answer_.radius();
  if (answer_.has_summary()) *whole_.mutable_summary() = answer_.summary();
  bytes_ += answer.Length();
  return bytes_ <= most_bytes_;
}

void SurveyFormat::close(std::string& out) {
  wire::Json().append(whole_, out);
  out += '\n';
}

template class JsonLinesFormat<v1::CompensateProgramResponse>;
template class JsonLinesFormat<v1::PreviewPathResponse>;
template class PathAnswerFormat<v1::CompensateProgramResponse>;
template class PathAnswerFormat<v1::PreviewPathResponse>;

}  // namespace trc::server::http
