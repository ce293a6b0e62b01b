#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"

namespace trc {

// All that the words of a block say, in this order: modes, tool and radius, compensation, what is
// passed on, motion, the end of the program.
bool apply_block(Reading& reading, ProgramLine& line, BlockWords& block);

// CDON of Sinumerik, M120 of Heidenhain: G141 with REMOVE_MASKED_BLOCKS.
bool leave_out_bottlenecks(Reading& reading, const Source& source);
// Without them the setup decides.
bool treat_bottlenecks_by_setup(Reading& reading, const Source& source);

// The words of `request` are those of the line; the rest is in force.
bool move(Reading& reading, ProgramLine& line, MoveRequest& request);

// The words of one role as one text, in their order.
bool pass_words(Reading& reading, const ProgramLine& line, WordRole role);

}  // namespace trc
