#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/trc/lead_settings.h"

namespace trc {

struct Limits {
  // Window of contour masking in relevant blocks; 0: the whole selection (D-10).
  std::size_t look_ahead_blocks = 0;
  // Passive blocks between two relevant ones (D-24, 90011).
  std::size_t passive_blocks = 100;
  // Relevant blocks in one selection that has to be held as a whole.
  std::size_t selection_blocks = 20'000'000;
};

// The way of blocks in the middle of a contour. The output is the same; for tests.
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

}  // namespace trc
