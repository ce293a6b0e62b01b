#include "server/rpc/survey_radii.h"

#include <utility>

#include "proto/wire/block.h"
#include "proto/wire/diagnostic.h"
#include "server/rpc/setup.h"

namespace trc::server {

Turn SurveyRadii::take(const v1::SurveyRadiiRequest& request, v1::SurveyRadiiResponse& response) {
  using Request = v1::SurveyRadiiRequest;
  if (const auto unknown = wire::unknown_field_in(request)) return end(refuse(*unknown));
  if (request.request_case() == Request::REQUEST_NOT_SET)
    return end(refuse(Refusal::request_empty, "setup, text or blocks", {{"field", "request"}}));
  if (request.request_case() == Request::kSetup) return set_up(request.setup(), response);
  if (!settings_) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  std::optional<Ending> refused;
  if (request.request_case() == Request::kText) {
    refused = keep(request.text());
  } else {
    if (request.request_case() == Request::kBatch)
      refused = keep(request.batch(), "batch", request.batch().blocks_size());
    else
      refused = keep(request.columns(), "columns",
                     static_cast<std::int64_t>(request.columns().kinds().size()));
    if (!refused) batches_.push_back(request);
  }
  if (refused) return end(*refused);
  stream_.pass();
  response.Clear();
  if (whole_) return survey(response);
  stream_.record.sent(0);
  return {.write = true, .next = Turn::Next::read, .ending = {}};
}

Turn SurveyRadii::set_up(const v1::SurveySetup& message, v1::SurveyRadiiResponse& response) {
  stream_.record.received(0);
  if (settings_) return end(refuse(Refusal::setup_repeated, {}, {{"field", "setup"}}));
  const Config& config = stream_.backend.config;
  wire::SurveySettings settings;
  if (auto refused = read_setup(message, config, settings)) return end(*refused);
  stream_.record.set_client_tag(settings.program.path.client_tag);
  settings_ = std::move(settings);
  response.Clear();
  accept(config, *response.mutable_accepted());
  stream_.record.sent(0);
  return {.write = true, .next = Turn::Next::read, .ending = {}};
}

std::optional<Ending> SurveyRadii::refuse_piece(bool fits_setup, const char* field) const {
  if (whole_) return refuse(Refusal::input_after_final, {}, {{"field", field}});
  if (fits_setup) return std::nullopt;
  wire::FieldFaults faults;
  wire::add_fault(wire::FieldPath(field), "does not fit the input that the setup names", faults);
  return refuse(faults);
}

std::optional<Ending> SurveyRadii::keep(const v1::ProgramText& text) {
  stream_.record.received(0);
  if (auto refused = refuse_piece(!settings_->is_path, "text")) return refused;
  if (text.first_byte() != next_) {
    const std::string expected = std::to_string(next_);
    const std::string got = std::to_string(text.first_byte());
    return refuse(Refusal::text_out_of_sequence, "expected " + expected + ", got " + got,
                  {{"expected", expected}, {"got", got}});
  }
  text_ += text.text();
  next_ += text.text().size();
  whole_ = text.final();
  return std::nullopt;
}

template <class Batch>
std::optional<Ending> SurveyRadii::keep(const Batch& batch, const char* field,
                                        std::int64_t blocks) {
  stream_.record.received(static_cast<std::uint64_t>(blocks));
  if (auto refused = refuse_piece(settings_->is_path, field)) return refused;
  if (batch.first_block() != next_) {
    const std::string expected = std::to_string(next_);
    const std::string got = std::to_string(batch.first_block());
    return refuse(Refusal::batch_out_of_sequence, "expected " + expected + ", got " + got,
                  {{"expected", expected}, {"got", got}});
  }
  if (const std::uint32_t most = stream_.backend.config.max_blocks_per_batch; blocks > most)
    return refuse_batch_of(std::to_string(blocks), most);
  next_ += static_cast<std::uint64_t>(blocks);
  whole_ = batch.final();
  return std::nullopt;
}

void SurveyRadii::read_path(ProgramState& state, wire::FieldFaults& faults) const {
  wire::BlockReader reader(settings_->program.path.session.program.tracking_axes.size());
  // After each group the survey checks that the client is still there.
  constexpr unsigned group = 256;
  unsigned given = 0;
  const auto give = [&](const wire::PathInput& input) {
    if (++given % group == 0) stream_.pass();
    return wire::apply(input, state);
  };
  for (const v1::SurveyRadiiRequest& request : batches_) {
    const bool goes_on = request.has_batch() ? reader.read(request.batch(), give, faults)
                                             : reader.read(request.columns(), give, faults);
    if (!goes_on) return;
  }
  state.end({.index = reader.next_block()});
}

Turn SurveyRadii::survey(v1::SurveyRadiiResponse& response) {
  const SessionSetup session = stream_.interruptible(settings_->program.path.session);
  survey::Reader reader;
  if (settings_->is_path)
    reader = [this](ProgramState& state, Diagnostics& /*log*/) { read_path(state, faults_); };
  else
    reader = survey::text_reader(text_,
                                 {.longest_line = stream_.backend.config.max_line_bytes,
                                  .most_faults = ProgramSessionSetup{}.most_faults},
                                 [this] { stream_.pass(); });
  survey_.emplace(survey::SurveySetup{.session = session,
                                      .uncut = settings_->wants_uncut,
                                      .progressed = [this] { stream_.account.progressed(); }},
                  std::move(reader));
  const bool is_read = survey_->read();
  if (!faults_.empty()) return end(refuse(faults_));
  for (const Diagnostic& found : survey_->diagnostics()) {
    wire::to_proto(found, *response.add_diagnostics());
    if (found.severity == Severity::error && !is_read && !refused_) refused_ = refuse(found);
  }
  stream_.record.taken(survey_->blocks());
  stream_.record.sent(0);
  return {.write = true, .next = Turn::Next::proceed, .ending = {}};
}

Turn SurveyRadii::proceed(v1::SurveyRadiiResponse& response) {
  if (refused_) return end(*refused_);
  response.Clear();
  stream_.account.progressed();
  stream_.record.sent(0);
  if (radii_done_ < settings_->radii.size()) {
    wire::to_proto(survey_->run(settings_->radii[radii_done_++]), *response.mutable_radius());
    return {.write = true, .next = Turn::Next::proceed, .ending = {}};
  }
  v1::SurveySummary& summary = *response.mutable_summary();
  // Without blocks every radius would be the largest.
  if (settings_->wants_largest && survey_->blocks() > 0)
    wire::to_proto(survey_->largest(), *summary.mutable_largest());
  summary.set_blocks(survey_->blocks());
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started_;
  summary.set_wall_time_seconds(wall.count());
  done_ = true;
  return {.write = true, .next = Turn::Next::read, .ending = {}};
}

Turn SurveyRadii::ended(v1::SurveyRadiiResponse& /*response*/) {
  if (!settings_) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  return end(done_ ? Ending{} : refuse(Refusal::contour_incomplete));
}

}  // namespace trc::server
