#include "server/rpc/path_run.h"

#include <string>
#include <vector>

#include "core/base/archive.h"

namespace trc::server {

PathRun::PathRun(const StreamContext& stream, const wire::PathSettings& settings)
    : stream_(stream),
      layout_(settings.response_layout),
      session_(in_portions(stream.interruptible(settings.session))),
      reader_(settings.session.program.tracking_axes.size()),
      answers_(stream.backend, stream.record),
      meter_(settings.session.compensator.limits),
      verifies_(settings.session.verify != Verify::off) {}

SessionSetup PathRun::in_portions(SessionSetup setup) {
  setup.compensator.take_portion = [this](auto& blocks) {
    answers_.outbox().keep_portion(blocks);
    stream_.account.progressed();
  };
  return setup;
}

template <class Batch>
void PathRun::feed_batch(const Batch& batch, const char* field, std::int64_t blocks) {
  stream_.record.received(static_cast<std::uint64_t>(blocks));
  answers_.begin();
  if (finished_)
    return answers_.end_with(refuse(Refusal::input_after_final, {}, {{"field", field}}));
  if (batch.first_block() != reader_.next_block()) {
    const std::string expected = std::to_string(reader_.next_block());
    const std::string got = std::to_string(batch.first_block());
    return answers_.end_with(refuse(Refusal::batch_out_of_sequence,
                                    "expected " + expected + ", got " + got,
                                    {{"expected", expected}, {"got", got}}));
  }
  const std::uint32_t most = stream_.backend.config.max_blocks_per_batch;
  if (blocks > most)
    return answers_.end_with(
        refuse(Refusal::batch_too_large, {},
               {{"max_blocks_per_batch", std::to_string(most)}, {"got", std::to_string(blocks)}}));
  // Corners give transition blocks too. All would be moved again and again while their number
  // grows.
  std::vector<CompensatedBlock>& ready = answers_.outbox().content().blocks;
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
  if (answers_.failed()) return;
  if (advance() && !faults.empty()) answers_.end_with(refuse(faults));
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
  const bool goes_on = session_.advance(answers_.outbox().content());
  answers_.place(session_.diagnostics());
  return goes_on;
}

// A verification measures a selection as a whole once it has ended.
bool PathRun::is_soon_done(std::uint64_t blocks) const {
  return !verifies_ && meter_.holds_few() && blocks <= Meter::few_blocks &&
         answers_.outbox().blocks_waiting() <= 2 * Meter::few_blocks;
}

std::string PathRun::resume_token(const ResumeTokens::Digest& setup) const {
  if (finished_ || answers_.failed()) return {};
  return stream_.backend.resume_tokens.seal(setup, [this](StateWriter& archive) {
    archive(session_, reader_, meter_, answers_.outbox().blocks_taken());
  });
}

std::optional<Ending> PathRun::resume(std::string_view token, const ResumeTokens::Digest& setup) {
  return stream_.backend.resume_tokens.open(token, setup, [this](StateReader& archive) {
    std::uint64_t blocks_out = 0;
    archive(session_, reader_, meter_, blocks_out);
    answers_.outbox().go_on_behind(blocks_out);
  });
}

void PathRun::finish() {
  if (finished_ || answers_.failed()) return;
  const Meter::Running running(meter_);
  finished_ = true;
  session_.finish({.index = reader_.next_block()}, answers_.outbox().content().blocks);
  answers_.place(session_.diagnostics());
  answers_.finish();
}

}  // namespace trc::server
