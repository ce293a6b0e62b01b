#include "server/rpc/answers.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace trc::server {

void Answers::place(Diagnostics& diagnostics) {
  if (diagnostics.pending().empty()) return;
  std::vector<Diagnostic> raised = diagnostics.take();
  // Several faults of reading may have been found in one run; the status tells the first.
  const auto error = std::ranges::find(raised, Severity::error, &Diagnostic::severity);
  if (diagnostics.stopped() && error != raised.end()) end_with(refuse(*error));
  outbox_.place(std::move(raised));
}

}  // namespace trc::server
