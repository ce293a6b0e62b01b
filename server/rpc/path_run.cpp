#include "server/rpc/path_run.h"

#include <string>
#include <vector>

namespace trc::server {

PathRun::PathRun(const StreamContext& stream, const Settings& settings)
    : StreamRun(stream, settings, settings.session),
      reader_(settings.session.program.tracking_axes.size()) {}

void PathRun::feed(const Request& request) {
  if (request.request_case() == Request::kBatch)
    feed_batch(request.batch());
  else
    feed_batch(request.columns());
}

void PathRun::feed(const v1::PreviewPathRequest& request) {
  if (request.path_case() == v1::PreviewPathRequest::kBatch) feed_batch(request.batch());
  if (request.path_case() == v1::PreviewPathRequest::kColumns) feed_batch(request.columns());
  finish();
}

void PathRun::feed_batch(const v1::BlockBatch& batch) {
  feed_batch(batch, "batch", batch.blocks_size());
}

void PathRun::feed_batch(const v1::BlockColumns& columns) {
  feed_batch(columns, "columns", static_cast<std::int64_t>(columns.kinds().size()));
}

template <class Batch>
void PathRun::feed_batch(const Batch& batch, const char* field, std::int64_t blocks) {
  stream_.record.received(static_cast<std::uint64_t>(blocks));
  responses_.begin();
  if (finished())
    return responses_.end_with(refuse(Refusal::input_after_final, {}, {{"field", field}}));
  if (batch.first_block() != reader_.next_block()) {
    const std::string expected = std::to_string(reader_.next_block());
    const std::string got = std::to_string(batch.first_block());
    return responses_.end_with(refuse(Refusal::batch_out_of_sequence,
                                      "expected " + expected + ", got " + got,
                                      {{"expected", expected}, {"got", got}}));
  }
  const std::uint32_t most = stream_.backend.config.max_blocks_per_batch;
  if (blocks > most) return responses_.end_with(refuse_batch_of(std::to_string(blocks), most));
  // Twice the blocks, because corners insert transition blocks. Without the reservation all blocks
  // would be moved each time the vector grows.
  std::vector<CompensatedBlock>& ready = answers().blocks();
  ready.reserve(ready.size() + static_cast<std::size_t>(2 * blocks));
  read(batch);
  if (batch.final()) finish();
}

template <class Batch>
void PathRun::read(const Batch& batch) {
  const Meter::Running running(meter_);
  wire::FieldFaults faults;
  items_ = 0;  // groups begin with a batch, so that a resumed stream has those of the unbroken one
  reader_.read(
      batch, [&](const wire::PathInput& input) { return give(input); }, faults);
  if (responses_.failed()) return;
  if (advance() && !faults.empty()) responses_.end_with(refuse(faults));
  note_progress();
}

bool PathRun::give(const wire::PathInput& input) {
  // Few enough items to stay in the caches.
  constexpr std::size_t group = 256;
  if (!wire::apply(input, session_.program())) return false;
  if (++items_ % group != 0) return true;
  stream_.pass();
  return advance();
}

void PathRun::finish() {
  if (finished() || responses_.failed()) return;
  const Meter::Running running(meter_);
  finish_session(Source{.index = reader_.next_block()});
}

void PathRun::summarize(v1::PathSummary& message) const {
  wire::to_proto(meter_.summary(session_), message);
}

std::string PathRun::resume_token(const ResumeTokens::Digest& setup) const {
  return token_of(setup, reader_);
}

std::optional<Ending> PathRun::resume(std::string_view token, const ResumeTokens::Digest& setup) {
  return go_on_from(token, setup, reader_);
}

bool PathRun::is_short(const Request* request) const {
  std::uint64_t blocks = 0;
  if (request != nullptr)
    blocks = request->has_columns() ? request->columns().kinds().size()
                                    : static_cast<std::uint64_t>(request->batch().blocks_size());
  return is_soon_done(blocks, 2 * Meter::few_blocks * sizeof(CompensatedBlock) - 1);
}

}  // namespace trc::server
