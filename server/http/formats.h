#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/wire/json_lines.h"
#include "server/http/problem.h"
#include "server/http/rpc_exchange.h"
#include "trc/v1/http.pb.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server::http {

// Keeps the diagnostics of a program: a refusal contains all of them.
class ProblemFormat : public Format {
 public:
  void refuse(const ExchangePointer& exchange, const grpc::Status& status) override;
  bool stop(const grpc::Status& status, std::string& out) override;

 protected:
  // The number of warnings and the first one, for answers that have no place for them.
  [[nodiscard]] Pairs warnings() const;

  template <class Diagnostics>
  void remember(const Diagnostics& diagnostics) {
    for (const v1::Diagnostic& diagnostic : diagnostics) {
      if (diagnostic.severity() == v1::Diagnostic::WARNING) ++warnings_;
      if (diagnostics_.size() < most_diagnostics) diagnostics_.push_back(diagnostic);
    }
  }

 private:
  static constexpr std::size_t most_diagnostics = 1000;
  std::vector<v1::Diagnostic> diagnostics_;
  std::size_t warnings_ = 0;
};

// NC text as it comes.
class NcTextFormat final : public ProblemFormat {
 public:
  [[nodiscard]] Head head() const override { return {.content_type = "text/plain; charset=utf-8"}; }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override;
  void close(std::string& /*out*/) override {}
  // Ends the text with a line that no control takes for a block.
  bool stop(const grpc::Status& status, std::string& out) override;
  [[nodiscard]] bool computes() const override { return false; }
  [[nodiscard]] Pairs headers_at_end() const override { return warnings(); }
  [[nodiscard]] std::string names_at_end() const override {
    return ", Trc-Warnings, Trc-First-Warning";
  }

 private:
  v1::CompensateProgramResponse answer_;
};

// The lines the command line writes with --format jsonl.
template <class Response>
class JsonLinesFormat final : public ProblemFormat {
 public:
  [[nodiscard]] Head head() const override { return {.content_type = "application/x-ndjson"}; }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override;
  void close(std::string& /*out*/) override {}

 private:
  Response answer_;
  v1::PathItem item_;
  wire::JsonLines lines_;
};

// A whole path as one JSON object, or all of it but the blocks.
template <class Response>
class PathAnswerFormat final : public ProblemFormat {
 public:
  enum class Blocks { given, left_out };
  PathAnswerFormat(Blocks blocks, std::size_t most_bytes)
      : blocks_(blocks), most_bytes_(most_bytes) {}

  [[nodiscard]] Head head() const override { return {.content_type = "application/json"}; }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override;
  void close(std::string& out) override;
  [[nodiscard]] bool streams() const override { return false; }

 private:
  Blocks blocks_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  Response answer_;
  v1::PathAnswer whole_;
};

// The record of a job as one JSON object; schema in proto/job_record.schema.json.
class RecordFormat final : public ProblemFormat {
 public:
  [[nodiscard]] Head head() const override { return {.content_type = "application/json"}; }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override;
  void close(std::string& out) override;
  [[nodiscard]] bool streams() const override { return false; }

 private:
  v1::CompensateProgramResponse answer_;
  std::string record_;
};

// The result of a survey as one JSON object.
class SurveyFormat final : public ProblemFormat {
 public:
  explicit SurveyFormat(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  [[nodiscard]] Head head() const override { return {.content_type = "application/json"}; }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override;
  void close(std::string& out) override;
  [[nodiscard]] bool streams() const override { return false; }

 private:
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  v1::SurveyRadiiResponse answer_;
  v1::SurveyAnswer whole_;
};

extern template class JsonLinesFormat<v1::CompensateProgramResponse>;
extern template class JsonLinesFormat<v1::PreviewPathResponse>;
extern template class PathAnswerFormat<v1::CompensateProgramResponse>;
extern template class PathAnswerFormat<v1::PreviewPathResponse>;

}  // namespace trc::server::http
