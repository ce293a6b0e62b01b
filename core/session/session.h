#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/program_state.h"
#include "core/session/verified_compensator.h"
#include "core/trc/compensator.h"

namespace trc {

struct SessionSetup {
  ProgramSetup program{};
  CompensatorSetup compensator{};
  bool verify = false;  // measure the path against the contour as it comes out
};

// One NC channel fed with motion blocks: no network, no text. Not thread-safe;
// may move between threads between calls.
class PathSession {
 public:
  explicit PathSession(const SessionSetup& setup);
  PathSession(const PathSession&) = delete;
  PathSession& operator=(const PathSession&) = delete;

  // Moves, commands and passthrough are given here, in path order.
  [[nodiscard]] ProgramState& program() { return program_; }

  // Compensates everything given since the last call and appends what has
  // become certain. Returns false once the stream must stop.
  bool advance(std::vector<CompensatedBlock>& out);
  // Ends the program (D-27) and appends all that was held back.
  bool finish(const Source& end, std::vector<CompensatedBlock>& out);

  // What a session with the same setup needs to go on here; only while the stream goes on. Holds
  // what has not come out yet.
  void save(StateWriter& archive) const;
  // Goes on there; nothing may have been given before. Throws when it is no such state.
  void load(StateReader& archive);

  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  [[nodiscard]] const Summary& summary() const { return compensator_.summary(); }
  // Null unless the setup asks for it.
  [[nodiscard]] const verify::ClearanceReport* clearance() const {
    return compensator_.clearance();
  }

 private:
  Diagnostics diagnostics_;
  std::vector<Block> blocks_;
  ProgramState program_;
  VerifiedCompensator compensator_;
};

}  // namespace trc
