#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/trc/result/compensated_block.h"

namespace trc {

// What one call of a session produced: `text` or `blocks`, as its setup asks.
struct ProgramOutput {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  // So many the caller has taken out of them already (TakePortion, too): places count them.
  std::size_t blocks_before = 0;
  // Where among them the diagnostics belong: behind all that is certain at the end of the line, or
  // of the item, in which they were reported. The same places come out however the input is cut.
  struct Place {
    std::size_t blocks = 0;
    std::size_t bytes = 0;
    std::size_t diagnostics = 0;  // so many of those pending belong here or before
  };
  std::vector<Place> places{};
};

}  // namespace trc
