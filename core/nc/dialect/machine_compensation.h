#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// G41 and D beside G150 of Haas are for its pocket. Where neither the line nor the output before it
// gives the register, the machine uses the one that was in force.
bool take_cycle_with_register(Reading& reading, ProgramLine& line, BlockWords& block);

// G10 L50 and L52 of Fanuc: the lines up to G11 write parameters of the control, with any
// meaning.
void take_parameters_of_control(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
