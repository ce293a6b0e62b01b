#pragma once

#include <cstdint>
#include <string_view>

#include "core/nc/dialect/reading.h"

namespace trc {

// A name that nobody knows here and that has nothing to do with the path.
[[nodiscard]] bool names_what_passes(const Reading& reading, std::string_view line,
                                     std::uint32_t begin);

// SETVN takes the rest of its line: a motion begun in front of it would lose its words there.
[[nodiscard]] bool cuts_off_words(const Reading& reading, const ProgramLine& line,
                                  std::uint32_t begin);

// `; Y20` behind other words: for many controls `;` ends the block, and what follows is the next
// one (D-53). Of words that move or switch nothing, as in `; D10`, people make comments.
[[nodiscard]] bool reads_as_block(std::string_view comment);

}  // namespace trc
