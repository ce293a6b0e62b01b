#pragma once

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_state.h"

namespace trc {

// Applies the words of a block: modes, tool side, pole, motion, the end of the program.
bool apply_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block);

// Moves, and keeps the direction at the end of the motion.
bool move_in_klartext(Reading& reading, ProgramLine& line, MoveRequest& request);

}  // namespace trc
