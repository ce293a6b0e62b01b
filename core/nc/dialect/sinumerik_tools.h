#pragma once

#include <cstdint>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Puts the row of the edge in force in the place of the D word, where the contour asks for it.
bool choose_tool_of_edge(Reading& reading, ProgramLine& line, BlockWords& block);

// Another tool, or another edge of that tool; `row` as row_of_edge() has it.
bool refuse_second_edge(Reading& reading, std::int64_t row);

}  // namespace trc
