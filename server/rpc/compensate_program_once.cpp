#include "server/rpc/compensate_program_once.h"

#include <string>

#include "server/rpc/setup.h"

namespace trc::server {
namespace {

void add(v1::CompensateProgramResponse& part, v1::CompensateProgramOnceResponse& whole) {
  using Part = v1::CompensateProgramResponse;
  whole.mutable_nc_text()->append(part.nc_text());
  whole.mutable_diagnostics()->MergeFrom(part.diagnostics());
  if (part.response_case() == Part::kBatch)
    whole.mutable_blocks()->MergeFrom(part.batch().blocks());
  if (part.response_case() == Part::kColumns) *whole.add_columns() = part.columns();
  if (part.response_case() == Part::kSummary) *whole.mutable_summary() = part.summary();
  if (!part.record().empty()) whole.set_record(part.record());
}

}  // namespace

Turn CompensateProgramOnce::take(const v1::CompensateProgramOnceRequest& request,
                                 v1::CompensateProgramOnceResponse& response) {
  if (const auto unknown = wire::unknown_field_in(request)) return end(refuse(*unknown));
  const wire::FieldPath setup("setup");
  if (const auto refused = refuse_tokens(request.setup().path(), wire::FieldPath(setup, "path"),
                                         "CompensateProgramOnce"))
    return end(*refused);
  response.Clear();
  v1::CompensateProgramRequest message;
  *message.mutable_setup() = request.setup();
  Turn turn = collect(program_.take(message, part_), response);
  if (turn.next == Turn::Next::finish) return turn;
  message.mutable_text()->set_text(request.text());
  message.mutable_text()->set_final(true);
  turn = collect(program_.take(message, part_), response);
  if (turn.next == Turn::Next::finish) return turn;
  turn = program_.ended(part_);
  turn.write = turn.ending.status.ok();
  return turn;
}

Turn CompensateProgramOnce::collect(Turn turn, v1::CompensateProgramOnceResponse& response) {
  for (;;) {
    if (turn.write) {
      const std::string bytes = part_.SerializeAsString();
      bytes_ += bytes.size();
      if (bytes_ > most_bytes_) return end(refuse(Refusal::answer_too_large));
      // Parsing turns blocks that are still bytes into messages, which `add` can merge.
      part_.ParseFromString(bytes);
      add(part_, response);
    }
    if (turn.next != Turn::Next::proceed) return turn;
    turn = program_.proceed(part_);
  }
}

Turn CompensateProgramOnce::proceed(v1::CompensateProgramOnceResponse& /*response*/) {
  return end({});
}

Turn CompensateProgramOnce::ended(v1::CompensateProgramOnceResponse& /*response*/) {
  return end({});
}

}  // namespace trc::server
