#include "server/rpc/responses.h"

namespace trc::server {

// Several faults of reading may have been found in one run; the status tells the first.
void Responses::end_with_error() {
  const Diagnostic* error = outbox_.error();
  if (error == nullptr) return;
  refused_ = !error_;
  end_with(refuse(*error));
}

}  // namespace trc::server
