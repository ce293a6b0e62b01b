#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/state.h"
#include "core/base/tolerances.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/walls/walls.h"

namespace trc {

struct Limits {
  // Window of contour masking in relevant blocks; 0: the whole selection (D-10).
  std::size_t look_ahead_blocks = 0;
  // Passive blocks between two relevant ones (D-24, 90011).
  std::size_t passive_blocks = 100;
  // Relevant blocks in one selection that has to be held as a whole.
  std::size_t selection_blocks = 20'000'000;
};

// Which way blocks in the middle of a contour go. What comes out is the same: for tests.
enum class Engine : std::uint8_t {
  automatic,  // the short way where enough of them come at once
  passes,     // each through all passes, also out of loop removal
  short_way,  // the short way for each that may take it
};

struct CompensatorSetup {
  Position start{};  // of the tool before the first block, mm
  Limits limits{};
  Tolerances tolerances{};
  bool implicit_contour_masking = false;  // P-CHAN-00219, D-34
  bool circular_kerf_masking = true;      // P-CHAN-00284
  LeadSettings leads{};                   // D-38
  double largest_masked_share = 0.5;      // of the walls, left out (D-39)
  double smallest_feed_factor = 0.01;     // D-31
  bool inverse_path = false;              // CompensatedBlock::inverse
  Engine engine = Engine::automatic;
  bool helps_with_entries = true;     // Diagnostic::entry_help
  Checkpoint::Interrupt interrupt{};  // of long work
};

// What a finished session did.
struct Summary {
  std::uint64_t blocks_in = 0;  // relevant and passive blocks
  std::uint64_t blocks_out = 0;
  std::array<std::uint64_t, origin_count> blocks_by_origin{};
  double programmed_length = 0;   // mm, in the plane
  double compensated_length = 0;  // mm, in the plane
};

// Programmed blocks in, compensated blocks out. The order of the passes is the
// list in Compensator::step (compensator.cpp) – start reading there.
class Compensator {
 public:
  Compensator(const CompensatorSetup& setup, Diagnostics& diagnostics);
  ~Compensator();
  Compensator(const Compensator&) = delete;
  Compensator& operator=(const Compensator&) = delete;

  // Takes all of `blocks` (left empty) and appends what has become certain.
  // Returns false once the stream must stop.
  bool feed(std::vector<Block>& blocks, std::vector<CompensatedBlock>& out);
  // As feed(), but no farther than to the end of the program line (Source::index) in which
  // something was reported that is pending, and to a selection that leaves in portions. Returns how
  // many blocks were taken.
  std::size_t feed_until_report(std::span<Block> blocks, std::vector<CompensatedBlock>& out);
  // No more blocks: appends all that was held back. `at_end` is the mode the
  // program ended in: a G40 nothing followed still ends the contour.
  bool finish(const TrcMode& at_end, std::vector<CompensatedBlock>& out);
  // As finish(), but no farther than to a selection that leaves in portions.
  bool finish_until_portion(const TrcMode& at_end, std::vector<CompensatedBlock>& out);

  // Blocks in a portion: the end of a selection sets free all of its path, which leaves in pieces
  // of that size and a few more.
  static constexpr std::size_t portion = 1024;
  // A portion has come out and more is to follow: release() before anything else.
  [[nodiscard]] bool is_releasing() const;
  // Appends until there is a portion in `out`, or all is out. Returns false once the stream must
  // stop.
  bool release(std::vector<CompensatedBlock>& out);

  void save(StateWriter& archive) const;
  void load(StateReader& archive);

  [[nodiscard]] const Summary& summary() const;
  // The most relevant blocks ever held back: the sum over the passes.
  [[nodiscard]] std::size_t look_ahead() const;

 private:
  // Takes the first block, or as many as nothing can be reported of. Returns how many.
  std::size_t take(std::span<Block> blocks, std::vector<CompensatedBlock>& out);

  struct Passes;
  std::unique_ptr<Passes> passes_;
};

}  // namespace trc
