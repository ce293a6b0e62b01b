#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/state/program_state.h"
#include "core/session/program_output.h"
#include "core/session/verified_compensator.h"
#include "core/trc/compensator.h"

namespace trc {

struct SessionSetup {
  ProgramSetup program{};
  CompensatorSetup compensator{};
  Verify verify = Verify::off;            // measure the path against the walls as it comes out
  Language language = Language::english;  // of the texts of diagnostics
};

// The program as the setup of the compensation has it: with P-CHAN-00284 = 0 masking switches
// KERF_MASKING.
[[nodiscard]] ProgramSetup program_setup(const SessionSetup& setup);

// One NC channel fed with motion blocks: no network, no text. Not thread-safe;
// may move between threads between calls.
class PathSession {
 public:
  explicit PathSession(const SessionSetup& setup);
  PathSession(const PathSession&) = delete;
  PathSession& operator=(const PathSession&) = delete;

  // Moves, commands and passthrough are given here, in path order.
  [[nodiscard]] ProgramState& program() { return program_; }

  // Compensates everything given since the last call and appends what has become certain, with
  // the places of diagnostics among it: they do not depend on how much is given between two calls.
  // Returns false once the stream must stop.
  bool advance(ProgramOutput& out);
  bool advance(std::vector<CompensatedBlock>& out);
  // Ends the program (D-27) and appends all that was held back.
  bool finish(const Source& end, std::vector<CompensatedBlock>& out);

  // What a session with the same setup needs to go on here; only while the stream goes on. Holds
  // what has not come out yet.
  void save(StateWriter& archive) const;
  // Goes on there; nothing may have been given before. Throws when it is no such state.
  void load(StateReader& archive);

  // What advance() and finish() have reported, and behind it what was found in what they have not
  // seen yet.
  [[nodiscard]] Diagnostics& diagnostics();
  [[nodiscard]] const Summary& summary() const { return compensator_.summary(); }
  // Null unless the setup asks for it.
  [[nodiscard]] const verify::ClearanceReport* clearance() const {
    return compensator_.clearance();
  }
  // Of the tool radius in force.
  [[nodiscard]] const RadiusTerms& radius_terms() const { return program_.tool().terms(); }
  // Memory the measurement holds, and what it will take in addition, bytes.
  [[nodiscard]] std::size_t verification_bytes() const { return compensator_.verification_bytes(); }

 private:
  void compensate_before(std::uint64_t index, std::span<Block>& left, ProgramOutput& out);
  void place(ProgramOutput& out);

  Diagnostics diagnostics_;
  // What is found in the program waits here until the blocks before it are compensated.
  Diagnostics read_diagnostics_;
  std::size_t placed_ = 0;  // of the pending diagnostics
  ProgramOutput output_;    // of a caller who does not ask for places
  std::vector<Block> blocks_;
  ProgramState program_;
  VerifiedCompensator compensator_;
};

}  // namespace trc
