#include "core/session/session.h"

namespace trc {

PathSession::PathSession(const SessionSetup& setup)
    : program_(setup.program, setup.compensator.tolerances, diagnostics_, blocks_),
      compensator_(setup.compensator, diagnostics_) {}

bool PathSession::advance(std::vector<CompensatedBlock>& out) {
  return compensator_.feed(blocks_, out);
}

bool PathSession::finish(const Source& end, std::vector<CompensatedBlock>& out) {
  return program_.end(end) && compensator_.feed(blocks_, out) &&
         compensator_.finish(program_.mode(), out);
}

}  // namespace trc
