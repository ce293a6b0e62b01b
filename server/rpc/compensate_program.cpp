#include "server/rpc/compensate_program.h"

#include <algorithm>
#include <string>

#include "core/base/archive.h"
#include "server/rpc/setup.h"

namespace trc::server {
namespace {

// After so much text it is asked whether the client is still there.
constexpr std::size_t bytes_per_piece = 16U << 10U;
// A few lines, or blocks.
constexpr std::size_t few_bytes = 16U << 10U;
// So much output leaves before more input is taken.
constexpr std::size_t much_output_bytes = 512U << 10U;

}  // namespace

CompensateProgram::Run::Run(const StreamContext& stream_context, const wire::PathSettings& settings,
                            const ProgramSessionSetup& setup)
    : stream(stream_context),
      layout(settings.response_layout),
      session(watched(setup)),
      responses(stream.backend, stream.record),
      meter(settings.session.compensator.limits),
      verifies(settings.session.verify != Verify::off) {}

ProgramSessionSetup CompensateProgram::Run::watched(ProgramSessionSetup setup) {
  setup.session.compensator.interrupt = [this] {
    if (responses.outbox().has_grown()) stream.account.progressed();
    stream.pass();
  };
  return setup;
}

bool CompensateProgram::Run::is_soon_done(std::uint64_t lines) const {
  return !verifies && input.empty() && meter.holds_few() && lines <= Meter::few_blocks &&
         !responses.outbox().holds(few_bytes + 1);
}

Turn CompensateProgram::take(const v1::CompensateProgramRequest& request,
                             v1::CompensateProgramResponse& response) {
  using Request = v1::CompensateProgramRequest;
  if (request.request_case() == Request::REQUEST_NOT_SET)
    return end(refuse(Refusal::request_empty, "setup or text", {{"field", "request"}}));
  if (request.request_case() == Request::kSetup) return set_up(request.setup(), response);
  if (!run_) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  feed(request.text());
  return proceed(response);
}

Turn CompensateProgram::set_up(const v1::ProgramSetup& message,
                               v1::CompensateProgramResponse& response) {
  stream_.record.received(0);
  if (run_) return end(refuse(Refusal::setup_repeated, {}, {{"field", "setup"}}));
  const Config& config = stream_.backend.config;
  wire::ProgramSettings settings;
  if (auto refused = read_setup(message, config, settings)) return end(*refused);
  stream_.record.set_client_tag(settings.path.client_tag);
  run_.emplace(stream_, settings.path,
               ProgramSessionSetup{.session = settings.path.session,
                                   .nc_text = settings.nc_text,
                                   .decimals = settings.decimals,
                                   .longest_line = config.max_line_bytes});
  want_tokens_ = settings.path.want_resume_tokens;
  if (want_tokens_ || !settings.path.resume_token.empty()) {
    v1::ProgramSetup without_token = message;
    without_token.mutable_path()->clear_resume_token();
    setup_ = ResumeTokens::digest_of(without_token);
  }
  if (!settings.path.resume_token.empty()) {
    if (auto refused = resume(settings.path.resume_token)) return end(*refused);
  }
  response.Clear();
  accept(config, *response.mutable_accepted());
  stream_.record.sent(0);
  return {.write = true, .next = Turn::Next::read, .ending = {}};
}

void CompensateProgram::feed(const v1::ProgramText& chunk) {
  Responses& responses = run_->responses;
  responses.begin();
  if (run_->finished) {
    stream_.record.received(0);
    return responses.end_with(refuse(Refusal::input_after_final, {}, {{"field", "text"}}));
  }
  if (chunk.first_byte() != run_->bytes_in) {
    const std::string expected = std::to_string(run_->bytes_in);
    const std::string got = std::to_string(chunk.first_byte());
    return responses.end_with(refuse(Refusal::text_out_of_sequence,
                                   "expected " + expected + ", got " + got,
                                   {{"expected", expected}, {"got", got}}));
  }
  stream_.record.received(0);
  run_->bytes_in += chunk.text().size();
  run_->input = chunk.text();
  run_->input_taken = 0;
  run_->input_is_final = chunk.final();
  go_on();
}

void CompensateProgram::go_on() {
  Responses& responses = run_->responses;
  const Meter::Running running(run_->meter);
  const std::string_view input = run_->input;
  bool goes_on = true;
  while (goes_on && run_->input_taken < input.size() &&
         !responses.outbox().holds(much_output_bytes)) {
    const std::string_view piece = input.substr(run_->input_taken, bytes_per_piece);
    goes_on = give(piece);
    run_->input_taken += piece.size();
  }
  const bool is_left = goes_on && run_->input_taken < input.size();
  if (goes_on && !is_left && run_->input_is_final) finish();
  if (!is_left) run_->input = std::string();
  responses.input_is_left(is_left);

  const Summary& so_far = run_->session.summary();
  stream_.record.taken(so_far.blocks_in - run_->blocks_seen);
  run_->blocks_seen = so_far.blocks_in;
  if (run_->meter.note(so_far)) stream_.account.progressed();
}

bool CompensateProgram::give(std::string_view text) {
  stream_.pass();
  Responses& responses = run_->responses;
  if (run_->session.feed(text, responses.outbox().content())) return true;
  responses.end_with_error();
  return false;
}

void CompensateProgram::finish() {
  run_->finished = true;
  if (!run_->session.finish(run_->responses.outbox().content())) run_->responses.end_with_error();
  run_->responses.finish();
}

Turn CompensateProgram::proceed(v1::CompensateProgramResponse& response) {
  if (run_->responses.outbox().empty() && !run_->input.empty()) go_on();
  return run_->responses.next(
      run_->layout, response,
      [&](const Outbox::Slice& slice, bool last) {
        response.mutable_nc_text()->assign(slice.text);
        run_->bytes_out += slice.text.size();
        response.set_consumed_bytes(last ? run_->bytes_in : run_->bytes_answered);
        if (last) run_->bytes_answered = run_->bytes_in;
        response.clear_resume_token();
        if (last && want_tokens_) *response.mutable_resume_token() = resume_token();
      },
      [&] {
        const wire::ProgramSummary summary{.path = run_->meter.summary(run_->session),
                                           .lines_in = run_->session.lines_read(),
                                           .bytes_in = run_->bytes_in,
                                           .bytes_out = run_->bytes_out};
        wire::to_proto(summary, *response.mutable_summary());
      });
}

std::string CompensateProgram::resume_token() {
  if (run_->finished || run_->responses.failed()) return {};
  return stream_.backend.resume_tokens.seal(setup_, [this](StateWriter& archive) {
    archive(*run_, run_->responses.outbox().blocks_taken());
  });
}

std::optional<Ending> CompensateProgram::resume(std::string_view token) {
  return stream_.backend.resume_tokens.open(token, setup_, [this](StateReader& archive) {
    std::uint64_t blocks_out = 0;
    archive(*run_, blocks_out);
    run_->bytes_answered = run_->bytes_in;
    run_->responses.outbox().go_on_behind(blocks_out);
  });
}

Turn CompensateProgram::ended(v1::CompensateProgramResponse& /*response*/) {
  if (!run_) return end(refuse(Refusal::setup_missing, {}, {{"field", "setup"}}));
  return end(run_->finished ? Ending{} : refuse(Refusal::contour_incomplete));
}

bool CompensateProgram::is_short(const v1::CompensateProgramRequest* request) const {
  if (!run_) return request == nullptr || request->setup().path().resume_token().empty();
  constexpr std::size_t bytes_per_line = 16;
  const std::size_t bytes = request == nullptr ? 0 : request->text().text().size();
  return !want_tokens_ && run_->is_soon_done(bytes / bytes_per_line);
}

}  // namespace trc::server
