#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/state.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/result/summary.h"
#include "core/trc/setup.h"

namespace trc {

// Programmed blocks in, compensated blocks out. The order of the passes is the list in
// `Passes::find_path`, continued by `finish_path` (compensator.cpp) – start reading there.
class Compensator {
 public:
  Compensator(const CompensatorSetup& setup, Diagnostics& diagnostics);
  ~Compensator();
  Compensator(const Compensator&) = delete;
  Compensator& operator=(const Compensator&) = delete;

  // Takes all of `blocks` (left empty) and appends what has become certain.
  // Returns false once the stream must stop.
  bool feed(std::vector<Block>& blocks, std::vector<CompensatedBlock>& out);
  // As feed(), but stops at the end of a program line (Source::index) with a pending
  // report, and at a selection that leaves in portions. Returns how many blocks were
  // taken.
  std::size_t feed_until_report(std::span<Block> blocks, std::vector<CompensatedBlock>& out);
  // No more blocks: appends all that was held back. `at_end` is the mode in which the program
  // ended: a G40 as its last block still ends the contour.
  bool finish(const TrcMode& at_end, std::vector<CompensatedBlock>& out);
  // As finish(), but stops at a selection that leaves in portions.
  bool finish_until_portion(const TrcMode& at_end, std::vector<CompensatedBlock>& out);

  // Blocks in a portion: the end of a selection under loop removal releases its whole path, which
  // leaves in pieces of about this size.
  static constexpr std::size_t blocks_per_portion = 1024;
  // A portion has come out and more follows: call release() before anything else.
  [[nodiscard]] bool is_releasing() const;
  // Appends until `out` holds a portion, or all is out. Returns false once the stream must
  // stop.
  bool release(std::vector<CompensatedBlock>& out);

  void save(StateWriter& archive) const;
  void load(StateReader& archive);

  [[nodiscard]] const Summary& summary() const;

 private:
  // Takes the first block, or all blocks that go the short way. Returns how many.
  std::size_t take(std::span<Block> blocks, std::vector<CompensatedBlock>& out);

  struct Passes;
  std::unique_ptr<Passes> passes_;
};

}  // namespace trc
