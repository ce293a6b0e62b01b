#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Works out what the words mean together, before any of them takes effect.
bool complete_gcode_block(Reading& reading, ProgramLine& line, BlockWords& block);

// The work offset in force, selected once more, changes nothing (D-111). What else moves
// coordinates, or may do so unseen, leaves open which one a selection after it goes back to.
void take_work_offset(Reading& reading, BlockWords& block);

}  // namespace trc
