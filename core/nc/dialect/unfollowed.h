#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Records the function under which coordinates mean something else from here on.
void take_what_is_unfollowed(Reading& reading, const ProgramLine& line, BlockWords& block);

// #CONTOUR BEGIN and #CONTOUR END of ISG: the lines between are copied, and no contour begins
// there.
void take_contour_of_cycle(Reading& reading, const ProgramLine& line, BlockWords& block);

// ISG: reads lines the short way, unless something is in force that they have to be asked about.
void read_plain_lines_again(Reading& reading);

// Copies threads of ISG, with the lines that continue them: they come out as they stand, and only
// the control knows where their axes stop (D-117, D-120).
bool copy_thread(Reading& reading, ProgramLine& line, BlockWords& block);

// G69, G50 and the like stand in the first line of many programs, where they end nothing.
void forget_what_ends_nothing(Reading& reading, BlockWords& block);

// Ends modes by words that also have another task: G49 and G43 end the control of the tool tip,
// G07.1 with 0 its cylinder (D-51), G113 is also G13.1, and G107 alone and G54.4 P0 end the modes
// that they begin with further words.
void end_what_was_unfollowed(Reading& reading, BlockWords& block);

}  // namespace trc
