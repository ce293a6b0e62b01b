#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Each word takes its place in `block`.
bool read_isg_words(Reading& reading, ProgramLine& line, BlockWords& block);

// What the words of a block must be together: which need another, which stand
// alone, and where axis letters are no positions.
bool check_isg_block(Reading& reading, ProgramLine& line, BlockWords& block);

// Not feed per minute: the number is technology like any other.
bool check_feed(Reading& reading, ProgramLine& line, const BlockWords& block);

}  // namespace trc
