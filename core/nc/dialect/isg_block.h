#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Checks the words of a block together: which need another word, which must stand alone, and where
// axis letters are no positions.
bool check_isg_block(Reading& reading, ProgramLine& line, BlockWords& block);

// Checks F. If it is no feed per minute, its number is technology like any other.
bool check_feed(Reading& reading, ProgramLine& line, const BlockWords& block);

}  // namespace trc
