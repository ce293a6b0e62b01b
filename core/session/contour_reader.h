#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/nc/program/program_reader.h"
#include "core/session/path_session.h"

namespace trc {

// Reads the programmed contour of NC text without compensating it; pictures and measurements
// compare the path with it. At an error in the text the contour ends; the session that compensates
// the same text reports the error.
class ContourReader {
 public:
  // The interrupt of the compensator is called from time to time.
  explicit ContourReader(const SessionSetup& session);

  // Gets blocks of the contour in their order, a few at a time. False: no more are wanted.
  using Taker = std::function<bool(std::vector<Block>)>;
  // Reads a whole text; no other call must have fed any.
  void read(std::string_view text, const Taker& take);

  // The text may be cut anywhere.
  void feed(std::string_view text);
  // After the last text: executes part of a program that computes. Returns whether more is left.
  bool resolve();
  // The blocks read so far, in their order, but for those taken before.
  [[nodiscard]] std::vector<Block> take() { return std::exchange(blocks_, {}); }
  // End of the text: executes what is left, and gives the blocks that have not been taken; nothing
  // may be fed after it.
  [[nodiscard]] std::vector<Block> finish();
  // Whether the text counts in inch in a block (Source::index) that was read.
  [[nodiscard]] bool is_inch(std::uint64_t block) {
    return diagnostics_.units().unit_in(block) == LengthUnit::inch;
  }

 private:
  Checkpoint::Interrupt interrupt_;
  Diagnostics diagnostics_;
  std::vector<Block> blocks_;
  ProgramState state_;
  ProgramReader reader_;
  std::vector<LinePointer> lines_;
  bool reading_ = true;

  void recycle();
};

}  // namespace trc
