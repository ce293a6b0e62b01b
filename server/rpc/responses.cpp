#include "server/rpc/responses.h"

namespace trc::server {

// A run may find several read faults; the status reports the first.
void Responses::end_with_error() {
  const Diagnostic* error = outbox_.error();
  if (error == nullptr) return;
  refused_ = !error_;
  end_with(refuse(*error));
}

}  // namespace trc::server
