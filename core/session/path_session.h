#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/state/program_state.h"
#include "core/session/answers.h"
#include "core/session/verified_compensator.h"
#include "core/trc/compensator.h"

namespace trc {

struct SessionSetup {
  ProgramSetup program{};
  CompensatorSetup compensator{};
  Verify verify = Verify::off;            // measure the path against the walls as it comes out
  Language language = Language::english;  // of the texts of diagnostics
  MeasuringProgress measuring{};          // is told of that while it goes on
};

// The program setup completed from that of the compensation: with P-CHAN-00284 = 0 masking switches
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
  // For diagnostics that the caller finds in them: each is reported after the item that it names
  // (Source::index).
  [[nodiscard]] Diagnostics& found() { return found_; }
  // The blocks given but not compensated yet.
  [[nodiscard]] std::span<const Block> waiting_blocks() const {
    return std::span(blocks_).subspan(next_);
  }

  // Compensates everything given since the last call and appends what has become certain. Returns
  // false once the stream must stop, or no more is wanted.
  bool advance(Answers& out);
  // Like advance(), but only for the items before this one.
  bool advance_before(std::uint64_t index, Answers& out);
  // Like advance_before(), with this item: more of it may follow, and its diagnostics wait.
  bool advance_through(std::uint64_t index, Answers& out);
  // Ends the path after the blocks given: appends all that was held back. Its diagnostics still
  // wait. Does nothing the second time.
  bool end(Answers& out);
  // Ends the item: its diagnostics are appended. Every function that advances does so too.
  void end_item(Answers& out);
  // Ends the program (D-27), advances and ends the path.
  bool finish(const Source& end, Answers& out);
  // Stops the stream with an error that no item has caused; the next call appends it.
  void stop(Diagnostic error) { diagnostics_.report(std::move(error)); }

  // Saves all that a session with the same setup needs to go on here, output held back included;
  // only while the stream goes on.
  void save(StateWriter& archive) const;
  // Goes on from a saved state; nothing may have been given before. Throws if it is no such state.
  void load(StateReader& archive);

  // The numbers of diagnostics, and whether one has stopped the stream.
  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const Summary& summary() const { return compensator_.summary(); }
  // Null unless the setup asks for it.
  [[nodiscard]] const verify::ClearanceReport* clearance() const {
    return compensator_.clearance();
  }
  // The parts of the tool radius in force.
  [[nodiscard]] const RadiusTerms& radius_terms() const { return program_.tool().terms(); }
  // Memory the measurement holds, and what it will take in addition, bytes.
  [[nodiscard]] std::size_t verification_bytes() const { return compensator_.verification_bytes(); }

 private:
  // Compensates the items before `end`, except those that wait for the next input.
  void work_off(std::uint64_t end, Answers& out);
  void compensate_before(std::uint64_t end, Answers& out);
  // Releases a selection that has ended, in portions.
  void release(Answers& out);
  [[nodiscard]] bool goes_on(const Answers& out) const {
    return !diagnostics_.stopped() && out.wanted();
  }

  Diagnostics diagnostics_;
  Diagnostics found_;
  std::vector<Diagnostic> to_tell_;  // of what was found: the items are to be compensated first
  std::vector<Block> blocks_;        // given; the first `next_` are compensated
  std::size_t next_ = 0;
  std::uint64_t open_item_ = no_item;  // what is reported of it is not told yet
  bool ended_ = false;
  ProgramState program_;
  VerifiedCompensator compensator_;

  static constexpr std::uint64_t no_item = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace trc
