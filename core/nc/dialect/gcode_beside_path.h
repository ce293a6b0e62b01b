#pragma once

#include <cstdint>
#include <string_view>

#include "core/nc/dialect/reading.h"

namespace trc {

// Whether the line names something unknown that does not affect the path.
[[nodiscard]] bool names_what_passes(const Reading& reading, std::string_view line,
                                     std::uint32_t begin);

// SETVN takes the rest of its line: a motion begun before it would lose its words there.
[[nodiscard]] bool cuts_off_words(const Reading& reading, const ProgramLine& line,
                                  std::uint32_t begin);

// `; Y20` after other words: for many controls `;` ends the block, and what follows is the next
// one (D-53). Words that neither move nor switch anything, as in `; D10`, count as a comment.
[[nodiscard]] bool reads_as_block(std::string_view comment);

}  // namespace trc
