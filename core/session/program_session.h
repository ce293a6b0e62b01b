#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/answers.h"
#include "core/session/path_session.h"

namespace trc {

struct ProgramSessionSetup {
  SessionSetup session{};
  bool nc_text = true;                   // output as NC text; false: compensated blocks
  std::size_t longest_line = 64 * 1024;  // bytes; 900006 beyond
  // The number of different faults of reading reported in one run, at the latest at its end.
  std::size_t most_faults = 50;
  // Gets each block of the programmed contour once, after it has been read and before it is
  // compensated. An error of the compensation ends this too.
  std::function<void(std::span<const Block>)> blocks_read{};
};

// One NC channel fed with NC text: a reader, a PathSession and a writer. The text may be cut
// anywhere, also inside a word or a UTF-8 character: the output is the same.
//
// NC text output is the program with TRC resolved: G40 throughout, N words,
// comments and technology words kept, G01/G02/G03 with the centre mode of the
// source. Lines that TRC does not touch come out byte for byte as written.
class ProgramSession {
 public:
  explicit ProgramSession(const ProgramSessionSetup& setup);
  ~ProgramSession();
  ProgramSession(const ProgramSession&) = delete;
  ProgramSession& operator=(const ProgramSession&) = delete;

  // Appends to `out` all that has become certain. Returns false once the stream must stop, or no
  // more is wanted.
  bool feed(std::string_view text, Answers& out);
  // After the last text: executes part of a program that computes, and appends all that has become
  // certain. Returns whether more is left, so that a caller can serve others in between.
  bool resolve(Answers& out);
  // End of the text; executes what is left.
  bool finish(Answers& out);

  // As PathSession::save, with an unfinished line and the text of a program that computes. Not
  // after the first call of `resolve`.
  void save(StateWriter& archive) const;
  void load(StateReader& archive);

  // As of PathSession.
  [[nodiscard]] const Diagnostics& diagnostics() const;
  [[nodiscard]] const Summary& summary() const;
  // Null unless the setup asks for it.
  [[nodiscard]] const verify::ClearanceReport* clearance() const;
  // As of PathSession.
  [[nodiscard]] std::size_t verification_bytes() const;
  [[nodiscard]] const RadiusTerms& radius_terms() const;
  [[nodiscard]] std::uint64_t lines_read() const;
  // A line that computes has been seen.
  [[nodiscard]] bool is_computing() const;
  // Of a program that computes.
  [[nodiscard]] std::uint64_t executed_lines() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trc
