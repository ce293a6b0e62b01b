#pragma once

#include "server/rpc/compensate_stream.h"
#include "server/rpc/program_run.h"

namespace trc::server {

// The setup, then NC text cut anywhere, the last piece of it final.
using CompensateProgram = CompensateStream<ProgramRun>;

}  // namespace trc::server
