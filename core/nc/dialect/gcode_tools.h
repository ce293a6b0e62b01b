#pragma once

#include <cstdint>
#include <optional>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Checks what G41, G42 and D words need.
bool check_gcode_selection(Reading& reading, ProgramLine& line, BlockWords& block);

// The radius of the setup stands for the one register that the program selects with, where it has
// no tools (D-65). D0 may have taken it out of force.
bool take_only_register(Reading& reading, const ProgramLine& line, BlockWords& block,
                        std::int64_t number);

// The diameter of the tool that M6 has put into the spindle, wear included, mm.
[[nodiscard]] std::optional<double> spindle_diameter(const Reading& reading);

}  // namespace trc
