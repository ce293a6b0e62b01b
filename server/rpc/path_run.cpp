#include "server/rpc/path_run.h"

#include <string>
#include <vector>

#include "core/base/archive.h"

namespace trc::server {

PathRun::PathRun(const StreamContext& stream, const wire::PathSettings& settings)
    : stream_(stream),
      layout_(settings.response_layout),
      session_(watched(settings.session)),
      reader_(settings.session.program.tracking_axes.size()),
      responses_(stream.backend, stream.record),
      meter_(settings.session.compensator.limits),
      verifies_(settings.session.verify != Verify::off) {}

SessionSetup PathRun::watched(SessionSetup setup) {
  setup.compensator.interrupt = [this] {
    if (responses_.outbox().has_grown()) stream_.account.progressed();
    stream_.pass();
  };
  return setup;
}

template <class Batch>
void PathRun::feed_batch(const Batch& batch, const char* field, std::int64_t blocks) {
  stream_.record.received(static_cast<std::uint64_t>(blocks));
  responses_.begin();
  if (finished_)
    return responses_.end_with(refuse(Refusal::input_after_final, {}, {{"field", field}}));
  if (batch.first_block() != reader_.next_block()) {
    const std::string expected = std::to_string(reader_.next_block());
    const std::string got = std::to_string(batch.first_block());
    return responses_.end_with(refuse(Refusal::batch_out_of_sequence,
                                    "expected " + expected + ", got " + got,
                                    {{"expected", expected}, {"got", got}}));
  }
  const std::uint32_t most = stream_.backend.config.max_blocks_per_batch;
  if (blocks > most)
    return responses_.end_with(
        refuse(Refusal::batch_too_large, {},
               {{"max_blocks_per_batch", std::to_string(most)}, {"got", std::to_string(blocks)}}));
  // Corners give transition blocks too. All would be moved again and again while their number
  // grows.
  std::vector<CompensatedBlock>& ready = responses_.outbox().content().blocks();
  ready.reserve(ready.size() + static_cast<std::size_t>(2 * blocks));
  read(batch);
  if (batch.final()) finish();
}

template <class Batch>
void PathRun::read(const Batch& batch) {
  const Meter::Running running(meter_);
  wire::FieldFaults faults;
  items_ = 0;  // groups begin with a batch: a resumed stream has those of the unbroken one
  reader_.read(
      batch, [&](const wire::PathInput& input) { return give(input); }, faults);
  if (responses_.failed()) return;
  if (advance() && !faults.empty()) responses_.end_with(refuse(faults));
  if (meter_.note(session_.summary())) stream_.account.progressed();
}

void PathRun::feed(const v1::BlockBatch& batch) { feed_batch(batch, "batch", batch.blocks_size()); }

void PathRun::feed(const v1::BlockColumns& columns) {
  feed_batch(columns, "columns", static_cast<std::int64_t>(columns.kinds().size()));
}

bool PathRun::give(const wire::PathInput& input) {
  // So many items at once: few enough to lie in the caches still.
  constexpr std::size_t group = 256;
  if (!wire::apply(input, session_.program())) return false;
  if (++items_ % group != 0) return true;
  stream_.pass();
  return advance();
}

bool PathRun::advance() {
  if (session_.advance(responses_.outbox().content())) return true;
  responses_.end_with_error();
  return false;
}

// A verification measures a selection as a whole once it has ended.
bool PathRun::is_soon_done(std::uint64_t blocks) const {
  return !verifies_ && meter_.holds_few() && blocks <= Meter::few_blocks &&
         !responses_.outbox().holds(2 * Meter::few_blocks * sizeof(CompensatedBlock));
}

std::string PathRun::resume_token(const ResumeTokens::Digest& setup) const {
  if (finished_ || responses_.failed()) return {};
  return stream_.backend.resume_tokens.seal(setup, [this](StateWriter& archive) {
    archive(session_, reader_, meter_, responses_.outbox().blocks_taken());
  });
}

std::optional<Ending> PathRun::resume(std::string_view token, const ResumeTokens::Digest& setup) {
  return stream_.backend.resume_tokens.open(token, setup, [this](StateReader& archive) {
    std::uint64_t blocks_out = 0;
    archive(session_, reader_, meter_, blocks_out);
    responses_.outbox().go_on_behind(blocks_out);
  });
}

void PathRun::finish() {
  if (finished_ || responses_.failed()) return;
  const Meter::Running running(meter_);
  finished_ = true;
  if (!session_.finish({.index = reader_.next_block()}, responses_.outbox().content()))
    responses_.end_with_error();
  responses_.finish();
}

}  // namespace trc::server
