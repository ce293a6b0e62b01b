#include "server/rpc/answers.h"

#include <utility>
#include <vector>

namespace trc::server {

void Answers::place(Diagnostics& diagnostics) {
  if (diagnostics.pending().empty()) return;
  std::vector<Diagnostic> raised = diagnostics.take();
  if (diagnostics.stopped()) end_with(refuse(raised.back()));
  outbox_.place(std::move(raised));
}

}  // namespace trc::server
