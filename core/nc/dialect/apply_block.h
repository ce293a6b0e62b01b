#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"

namespace trc {

// Applies the words of a block in this order: modes, tool and radius, compensation, words that
// pass, motion, the end of the program.
bool apply_block(Reading& reading, ProgramLine& line, BlockWords& block);

// CDON of Sinumerik, M120 of Heidenhain: G141 with REMOVE_MASKED_BLOCKS.
bool leave_out_bottlenecks(Reading& reading, const Source& source);
// Bottlenecks are treated as the setup says: CDOF, M120 off.
bool treat_bottlenecks_by_setup(Reading& reading, const Source& source);

// `request` holds the words of the line; the modes in force complete it.
bool move(Reading& reading, ProgramLine& line, MoveRequest& request);

// Passes on the words of one role as one text, in their order.
bool pass_words(Reading& reading, const ProgramLine& line, WordRole role);

}  // namespace trc
