#pragma once

#include "server/rpc/compensate_stream.h"
#include "server/rpc/path_run.h"

namespace trc::server {

// The setup, then batches, the last of them final.
using CompensatePath = CompensateStream<PathRun>;

}  // namespace trc::server
