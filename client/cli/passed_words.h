#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "core/trc/result/compensated_block.h"

namespace trc::cli {

// A word or statement of a program, and where it occurs.
struct CountedWord {
  std::string text{};
  std::size_t times = 0;
  std::uint32_t line = 0;  // the first one
};

// What a program says besides its path, in the order of first occurrence.
struct PassedWords {
  std::vector<CountedWord> tools{};   // T words, and TOOL CALL of Klartext
  std::vector<CountedWord> passed{};  // G and M words, cycles, calls and other names
};

// Finds them in the text that blocks pass on.
[[nodiscard]] PassedWords passed_words(const std::vector<CompensatedBlock>& blocks,
                                       DialectName dialect);

}  // namespace trc::cli
