#pragma once

#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// T0101: the tool and its offset in one word, as on lathes.
[[nodiscard]] bool is_turning_tool(std::string_view word);

// Refuses the contours of lathes in the dialects of Fanuc, LinuxCNC and Sinumerik (D-105).
bool check_turning(Reading& reading, const ProgramLine& line, const BlockWords& block);

// Refuses them in ISG.
bool check_turning_of_isg(Reading& reading, const ProgramLine& line, const BlockWords& block);

// ISG: notes the axes of a line before its motion.
void note_axes(Reading& reading, AxisBits axes);

}  // namespace trc
