#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Makes each further turn a block of its own, before the arc that the other words describe.
bool move_in_full_turns(Reading& reading, ProgramLine& line, const BlockWords& block);

}  // namespace trc
