#include "server/rpc/program_run.h"

#include "core/nc/program/flow.h"
#include "core/nc/program/program_reader.h"

namespace trc::server {
namespace {

constexpr std::size_t bytes_per_piece = ProgramReader::bytes_between_questions;
// A few lines or blocks.
constexpr std::size_t few_bytes = 16U << 10U;
// This much output leaves before the run takes more input.
constexpr std::size_t much_output_bytes = 512U << 10U;

std::function<void(std::span<const Block>)> tapped_by(const StreamContext& stream) {
  if (stream.run_tap == nullptr) return {};
  return [&tap = *stream.run_tap](std::span<const Block> blocks) { tap.take_contour(blocks); };
}

}  // namespace

ProgramRun::ProgramRun(const StreamContext& stream, const Settings& settings)
    : StreamRun(stream, settings.path,
                {.session = settings.path.session,
                 .nc_text = settings.nc_text,
                 .longest_line = stream.backend.config.max_line_bytes,
                 .blocks_read = tapped_by(stream)}),
      gives_text_(settings.nc_text) {}

void ProgramRun::feed(const Request& request) {
  stream_.record.received(0);
  responses_.begin();
  take(request.text());
}

void ProgramRun::take(const v1::ProgramText& chunk) {
  if (finished())
    return responses_.end_with(refuse(Refusal::input_after_final, {}, {{"field", "text"}}));
  if (chunk.first_byte() != bytes_in_) {
    const std::string expected = std::to_string(bytes_in_);
    const std::string got = std::to_string(chunk.first_byte());
    return responses_.end_with(refuse(Refusal::text_out_of_sequence,
                                      "expected " + expected + ", got " + got,
                                      {{"expected", expected}, {"got", got}}));
  }
  bytes_in_ += chunk.text().size();
  if (record_) record_->add_input(chunk.text());
  input_ = chunk.text();
  input_taken_ = 0;
  input_is_final_ = chunk.final();
  go_on();
}

void ProgramRun::go_on() {
  const Meter::Running running(meter_);
  const std::string_view input = input_;
  bool open = true;
  while (open && input_taken_ < input.size() && !responses_.outbox().holds(much_output_bytes)) {
    const std::string_view piece = input.substr(input_taken_, bytes_per_piece);
    stream_.pass();
    open = goes_on(session_.feed(piece, answers()));
    give_to_tap();
    input_taken_ += piece.size();
  }
  const bool is_left = open && input_taken_ < input.size();
  if (!is_left) input_ = std::string();
  is_executing_ = open && !is_left && input_is_final_ && execute();
  if (open && !is_left && input_is_final_ && !is_executing_) finish_session();
  give_to_tap();
  responses_.input_is_left(is_left || is_executing_);

  const Summary so_far = session_.summary();
  stream_.record.taken(so_far.blocks_in - blocks_seen_);
  blocks_seen_ = so_far.blocks_in;
  // Blocks that leave as blocks are counted with their answers.
  if (gives_text_ || stream_.run_tap) stream_.record.given(so_far.blocks_out - blocks_written_);
  blocks_written_ = so_far.blocks_out;
  note_progress();
}

// Executes a program that computes until much output has come out, or all. True: some is left.
bool ProgramRun::execute() {
  while (!responses_.outbox().holds(much_output_bytes)) {
    stream_.pass();
    if (!session_.resolve(answers())) return false;
    give_to_tap();
  }
  return true;
}

void ProgramRun::give_to_tap() {
  if (!stream_.run_tap) return;
  responses_.outbox().take_blocks(
      [&](std::vector<CompensatedBlock>& blocks) { stream_.run_tap->take_path(blocks); });
}

void ProgramRun::summarize(v1::ProgramSummary& message) const {
  wire::to_proto(wire::ProgramSummary{.path = meter_.summary(session_),
                                      .lines_in = session_.lines_read(),
                                      .bytes_in = bytes_in_,
                                      .bytes_out = bytes_out_},
                 message);
}

void ProgramRun::add_to_record(const Outbox::Slice& slice, const Response& response) {
  record_->add_output(slice.text, slice.blocks);
  for (const v1::Diagnostic& told : response.diagnostics()) record_->add_told(told);
}

void ProgramRun::close_record(Response& response, const v1::ProgramSummary* summary) {
  response.set_record(record_->close(summary));
  record_.reset();
}

std::string ProgramRun::resume_token(const ResumeTokens::Digest& setup) const {
  // Lines collected for execution are sent again with the text since the last token.
  if (session_.is_computing()) return {};
  if (record_) return token_of(setup, bytes_in_, bytes_out_, blocks_seen_, *record_);
  return token_of(setup, bytes_in_, bytes_out_, blocks_seen_);
}

std::optional<Ending> ProgramRun::resume(std::string_view token,
                                         const ResumeTokens::Digest& setup) {
  auto refused = record_ ? go_on_from(token, setup, bytes_in_, bytes_out_, blocks_seen_, *record_)
                         : go_on_from(token, setup, bytes_in_, bytes_out_, blocks_seen_);
  bytes_answered_ = bytes_in_;
  blocks_written_ = session_.summary().blocks_out;
  return refused;
}

bool ProgramRun::is_short(const Request* request) const {
  constexpr std::size_t bytes_per_line = 16;
  const std::size_t bytes = request == nullptr ? 0 : request->text().text().size();
  // The execution that the last text starts may take long.
  const bool executes = is_executing_ || (request && request->text().final());
  return input_.empty() && !executes && is_soon_done(bytes / bytes_per_line, few_bytes);
}

}  // namespace trc::server
