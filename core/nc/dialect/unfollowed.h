#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Under which function coordinates mean something else from here on.
void take_what_is_unfollowed(Reading& reading, const ProgramLine& line, BlockWords& block);

// Threads of ISG, with the lines that go on under them: they come out as they stand, and only the
// control knows where their axes stop (D-117, D-120).
bool copy_thread(Reading& reading, ProgramLine& line, BlockWords& block);

// G69, G50 and the like stand in the first line of many programs, where there is nothing to end.
void forget_what_ends_nothing(Reading& reading, BlockWords& block);

// What is ended by words that have another task besides: G49 and G43 end the control of the tool
// tip, G07.1 with 0 its cylinder (D-51), G113 is G13.1 too, G107 alone and G54.4 P0 end what they
// begin with words.
void end_what_was_unfollowed(Reading& reading, BlockWords& block);

}  // namespace trc
