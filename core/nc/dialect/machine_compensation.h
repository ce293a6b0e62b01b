#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// G41 and D beside G150 of Haas are for its pocket. Where neither the line nor what comes out in
// front of it says the register, the machine takes the one that stood in force before.
bool take_cycle_with_register(Reading& reading, ProgramLine& line, BlockWords& block);

// G10 L50 and L52 of Fanuc: what the lines up to G11 write are parameters of the control, which may
// be anything.
void take_parameters_of_control(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
