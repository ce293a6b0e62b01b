#include "core/session/session.h"

#include "core/trc/state_archive.h"

namespace trc {
namespace {

// The tool and the program start in one place: the one the program names.
CompensatorSetup compensator_setup(const SessionSetup& setup) {
  CompensatorSetup result = setup.compensator;
  result.start = setup.program.start;
  return result;
}

}  // namespace

PathSession::PathSession(const SessionSetup& setup)
    : program_(setup.program, setup.compensator.tolerances, diagnostics_, blocks_),
      compensator_(compensator_setup(setup), setup.verify, diagnostics_) {}

bool PathSession::advance(std::vector<CompensatedBlock>& out) {
  return compensator_.feed(blocks_, out);
}

void PathSession::save(StateWriter& archive) const {
  archive(diagnostics_, program_, compensator_);
}
void PathSession::load(StateReader& archive) { archive(diagnostics_, program_, compensator_); }

bool PathSession::finish(const Source& end, std::vector<CompensatedBlock>& out) {
  return program_.end(end) && compensator_.feed(blocks_, out) &&
         compensator_.finish(program_.mode(), out);
}

}  // namespace trc
