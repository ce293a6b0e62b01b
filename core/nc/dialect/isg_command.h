#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/words.h"

namespace trc {

// Reads #TRC, #TANGFEED, #COMMENT and any other command that begins with #.
bool read_command(Reading& reading, const Word& word, ProgramLine& line, BlockWords& block);

// Between #COMMENT BEGIN and #COMMENT END. Whether such blocks nest depends on
// the setting of the control, so a second beginning is refused.
bool read_comment_block(Reading& reading, ProgramLine& line);

}  // namespace trc
