#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// X10 of Fanuc, which is 10 mm or 10 of its smallest steps (ProgramSetup::whole_numbers).
bool count_whole_numbers(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
