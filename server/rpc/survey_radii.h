#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/survey/survey.h"
#include "proto/wire/survey.h"
#include "server/rpc/stream_context.h"
#include "server/rpc/stream_work.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// SurveyRadii: the setup, then a program or a path as CompensateProgram and CompensatePath take
// them. The input is kept until it is complete, read once, and each radius gets a turn of its own.
class SurveyRadii final : public StreamWork<v1::SurveyRadiiRequest, v1::SurveyRadiiResponse> {
 public:
  explicit SurveyRadii(const StreamContext& stream) : stream_(stream) {}

  Turn take(const v1::SurveyRadiiRequest& request, v1::SurveyRadiiResponse& response) override;
  Turn proceed(v1::SurveyRadiiResponse& response) override;
  Turn ended(v1::SurveyRadiiResponse& response) override;

 private:
  Turn set_up(const v1::SurveySetup& message, v1::SurveyRadiiResponse& response);
  // Each keeps a piece of the input; returns the ending where it is not the next one.
  [[nodiscard]] std::optional<Ending> keep(const v1::ProgramText& text);
  template <class Batch>
  [[nodiscard]] std::optional<Ending> keep(const Batch& batch, const char* field,
                                           std::int64_t blocks);
  [[nodiscard]] std::optional<Ending> refuse_piece(bool fits_setup, const char* field) const;
  // After the last piece.
  Turn survey(v1::SurveyRadiiResponse& response);
  void read_path(ProgramState& state, wire::FieldFaults& faults) const;

  StreamContext stream_;
  std::optional<wire::SurveySettings> settings_;
  std::string text_;
  std::vector<v1::SurveyRadiiRequest> batches_;
  std::uint64_t next_ = 0;  // byte or block of the input
  bool whole_ = false;
  wire::FieldFaults faults_;  // of the batches
  std::optional<survey::Survey> survey_;
  std::optional<Ending> refused_;  // the program, whatever the radius
  std::size_t radii_done_ = 0;
  bool done_ = false;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace trc::server
